// SPDX-License-Identifier: BSD-3-Clause
// An articulated object as a joiner would list it: links of boxes and cylinders, and joints.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "lockbox/model/kinematic_tree.hpp"

namespace lockbox {

struct DraftPart {
  /// Edge lengths of a box, metres; of a cylinder along z: its diameter, the same once more, its
  /// length.
  Eigen::Vector3d size;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< in the link's frame, metres
  /// Roll, pitch, yaw as URDF has them, radians.
  Eigen::Vector3d rpy = Eigen::Vector3d::Zero();
  bool is_cylinder = false;
};

struct DraftLink {
  std::string name;
  std::vector<DraftPart> parts;
};

struct DraftJoint {
  std::string name;
  JointType type = JointType::prismatic;
  std::string child;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< in the parent's frame, metres
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  double lower = 0.0;  ///< metres or radians; of no meaning for continuous joints
  double upper = 0.0;
  std::string parent = {};  ///< empty: the first link
};

struct ObjectDraft {
  std::string name;
  std::vector<DraftLink> links;  ///< the first one is the base
  std::vector<DraftJoint> joints;
};

/// A box, or a cylinder along an axis (0: x, 1: y, 2: z); metres.
DraftPart box_part(const Eigen::Vector3d& size, const Eigen::Vector3d& centre);
DraftPart cylinder_part(double radius, double length, int axis, const Eigen::Vector3d& centre);

/// The same object `size` times as large.
ObjectDraft scaled(ObjectDraft draft, double size);

/// The text of a URDF file of the object.
std::string urdf_text(const ObjectDraft& draft);

}  // namespace lockbox
