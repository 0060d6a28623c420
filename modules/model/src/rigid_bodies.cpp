// SPDX-License-Identifier: BSD-3-Clause
#include "rigid_bodies.hpp"

#include <algorithm>
#include <limits>

#include "lockbox/core/error.hpp"
#include "lockbox/mesh/triangle_mesh.hpp"
#include "visual_mesh.hpp"

namespace lockbox {
namespace {

/// A link that waits to be visited, and the body that it belongs to.
struct Placement {
  urdf::LinkConstSharedPtr link;
  int body;
  Eigen::Isometry3d T_body_link;
};

JointType joint_type(const urdf::Joint& joint) {
  if (joint.type == urdf::Joint::CONTINUOUS) return JointType::continuous;
  return joint.type == urdf::Joint::PRISMATIC ? JointType::prismatic : JointType::revolute;
}

Joint movable_joint(const urdf::Joint& urdf_joint) {
  Joint joint;
  joint.name = urdf_joint.name;
  joint.type = joint_type(urdf_joint);
  joint.axis =
      Eigen::Vector3d(urdf_joint.axis.x, urdf_joint.axis.y, urdf_joint.axis.z).normalized();
  const bool limited = joint.type != JointType::continuous;
  joint.lower = limited ? urdf_joint.limits->lower : -std::numeric_limits<double>::infinity();
  joint.upper = limited ? urdf_joint.limits->upper : std::numeric_limits<double>::infinity();
  if (urdf_joint.mimic) {
    joint.is_mimic = true;
    joint.multiplier = urdf_joint.mimic->multiplier;
    joint.offset = urdf_joint.mimic->offset;
  }
  return joint;
}

void add_link(const Placement& placement, const MeshLocator& locator, double mesh_scale,
              const std::function<void(const std::string&, const std::string&)>& refuse_link,
              RigidBodies& result) {
  Body& body = result.bodies[static_cast<std::size_t>(placement.body)];
  const urdf::Link& link = *placement.link;
  body.links.push_back(link.name);
  for (const auto& visual : link.visual_array) {
    try {
      body.visuals.push_back(visual_mesh(*visual, locator, mesh_scale));
    } catch (const InputError& error) {
      refuse_link(link.name, error.what());
    }
    TriangleMesh& mesh = body.visuals.back().mesh;
    mesh = transformed(std::move(mesh), placement.T_body_link);
    VisualExtent extent = described(*visual->geometry);
    extent.link = link.name;
    extent.body = placement.body;
    extent.box = bounds(mesh);
    result.extents.push_back(extent);
  }
}

/// Opens the body that the joint moves, and returns its index.
int add_body(const urdf::Joint& urdf_joint, int parent_body, const Eigen::Isometry3d& T_body_joint,
             RigidBodies& result) {
  const int child_body = static_cast<int>(result.bodies.size());
  Joint joint = movable_joint(urdf_joint);
  joint.parent_body = parent_body;
  joint.child_body = child_body;
  joint.T_parent_joint = T_body_joint;
  if (urdf_joint.mimic) result.mimics.emplace(joint.name, urdf_joint.mimic->joint_name);
  Body body;
  body.name = urdf_joint.child_link_name;
  body.parent_joint = static_cast<int>(result.joints.size());
  result.joints.push_back(std::move(joint));
  result.bodies.push_back(std::move(body));
  return child_body;
}

}  // namespace

RigidBodies assemble_rigid_bodies(
    const urdf::ModelInterface& urdf, const MeshLocator& locator, double mesh_scale,
    const std::function<void(const std::string&, const std::string&)>& refuse_link) {
  RigidBodies result;
  result.bodies.emplace_back().name = urdf.getRoot()->name;
  std::vector<Placement> waiting{{urdf.getRoot(), 0, Eigen::Isometry3d::Identity()}};
  while (!waiting.empty()) {
    const Placement placement = waiting.back();
    waiting.pop_back();
    add_link(placement, locator, mesh_scale, refuse_link, result);
    for (const auto& joint : placement.link->child_joints) {
      const auto child = urdf.getLink(joint->child_link_name);
      const Eigen::Isometry3d T_body_joint =
          placement.T_body_link * isometry(joint->parent_to_joint_origin_transform);
      if (joint->type == urdf::Joint::FIXED) {
        waiting.push_back({child, placement.body, T_body_joint});
      } else {
        const int body = add_body(*joint, placement.body, T_body_joint, result);
        waiting.push_back({child, body, Eigen::Isometry3d::Identity()});
      }
    }
  }
  // The link that names the body first, the others in an order that the file has no say in.
  for (Body& body : result.bodies) std::sort(body.links.begin() + 1, body.links.end());
  return result;
}

}  // namespace lockbox
