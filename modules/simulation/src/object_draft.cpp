// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/simulation/object_draft.hpp"

#include <numbers>
#include <sstream>

#include "lockbox/core/number_text.hpp"
#include "lockbox/model/joint_type_name.hpp"

namespace lockbox {
namespace {

std::string triple(const Eigen::Vector3d& values) {
  return fixed_number_text(values.x()) + ' ' + fixed_number_text(values.y()) + ' ' +
         fixed_number_text(values.z());
}

std::string geometry(const DraftPart& part) {
  if (!part.is_cylinder) return "<box size=\"" + triple(part.size) + "\"/>";
  return "<cylinder radius=\"" + fixed_number_text(0.5 * part.size.x()) + "\" length=\"" +
         fixed_number_text(part.size.z()) + "\"/>";
}

void write_link(std::ostream& out, const DraftLink& link) {
  out << "  <link name=\"" << link.name << "\">\n";
  for (const DraftPart& part : link.parts) {
    out << "    <visual><origin xyz=\"" << triple(part.centre) << "\" rpy=\"" << triple(part.rpy)
        << "\"/><geometry>" << geometry(part) << "</geometry></visual>\n";
  }
  out << "  </link>\n";
}

void write_joint(std::ostream& out, const DraftJoint& joint, const std::string& parent) {
  out << "  <joint name=\"" << joint.name << "\" type=\"" << type_name(joint.type)
      << "\"><parent link=\"" << parent << "\"/><child link=\"" << joint.child
      << "\"/><origin xyz=\"" << triple(joint.origin) << "\"/><axis xyz=\"" << triple(joint.axis)
      << "\"/>";
  if (joint.type != JointType::continuous) {
    out << "<limit lower=\"" << fixed_number_text(joint.lower) << "\" upper=\""
        << fixed_number_text(joint.upper) << "\" effort=\"10\" velocity=\"1\"/>";
  }
  out << "</joint>\n";
}

}  // namespace

DraftPart box_part(const Eigen::Vector3d& size, const Eigen::Vector3d& centre) {
  return {size, centre, Eigen::Vector3d::Zero(), false};
}

DraftPart cylinder_part(double radius, double length, int axis, const Eigen::Vector3d& centre) {
  constexpr double kQuarterTurn = 0.5 * std::numbers::pi;
  Eigen::Vector3d rpy = Eigen::Vector3d::Zero();
  if (axis == 0) rpy.y() = kQuarterTurn;
  if (axis == 1) rpy.x() = kQuarterTurn;
  return {{2.0 * radius, 2.0 * radius, length}, centre, rpy, true};
}

ObjectDraft scaled(ObjectDraft draft, double size) {
  for (DraftLink& link : draft.links) {
    for (DraftPart& part : link.parts) {
      part.size *= size;
      part.centre *= size;
    }
  }
  for (DraftJoint& joint : draft.joints) {
    joint.origin *= size;
    if (joint.type != JointType::prismatic) continue;
    joint.lower *= size;
    joint.upper *= size;
  }
  return draft;
}

std::string urdf_text(const ObjectDraft& draft) {
  std::ostringstream out;
  out << "<?xml version=\"1.0\"?>\n<robot name=\"" << draft.name << "\">\n";
  for (const DraftLink& link : draft.links) write_link(out, link);
  for (const DraftJoint& joint : draft.joints) {
    write_joint(out, joint, joint.parent.empty() ? draft.links.front().name : joint.parent);
  }
  out << "</robot>\n";
  return out.str();
}

}  // namespace lockbox
