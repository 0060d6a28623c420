// SPDX-License-Identifier: BSD-3-Clause
// Models built by hand, for tests that need no files.
#pragma once

#include <limits>
#include <string>

#include "lockbox/mesh/primitives.hpp"
#include "lockbox/model/kinematic_tree.hpp"

namespace lockbox::testing {

inline Body box_body(const std::string& name, const Eigen::Vector3d& size, int parent_joint) {
  Body body;
  body.name = name;
  body.links = {name};
  body.mesh = make_box(size);
  body.parent_joint = parent_joint;
  return body;
}

/// A board of 0.6 x 0.6 x 0.02 m with a door (0 to 1.9 rad), a slider (-0.1 to 0.2 m) and a disk
/// (continuous), each a body of its own in front of it.
inline KinematicTree board_with_three_joints() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  KinematicTree tree;
  tree.name = "board";
  tree.bodies = {box_body("board", {0.6, 0.6, 0.02}, -1), box_body("door", {0.2, 0.2, 0.02}, 0),
                 box_body("slider", {0.1, 0.1, 0.04}, 1), box_body("disk", {0.1, 0.1, 0.02}, 2)};
  const auto add_joint = [&](const char* name, JointType type, const Eigen::Vector3d& position,
                             const Eigen::Vector3d& axis, double lower, double upper) {
    Joint joint;
    joint.name = name;
    joint.type = type;
    joint.child_body = static_cast<int>(tree.joints.size()) + 1;
    joint.T_parent_joint.translation() = position;
    joint.axis = axis;
    joint.lower = lower;
    joint.upper = upper;
    joint.variable = static_cast<int>(tree.joints.size());
    tree.variable_joint.push_back(joint.variable);
    tree.file_order.push_back(joint.variable);
    tree.joints.push_back(joint);
  };
  add_joint("door", JointType::revolute, {-0.15, 0.0, 0.05}, Eigen::Vector3d::UnitY(), 0.0, 1.9);
  add_joint("slider", JointType::prismatic, {0.1, -0.1, 0.05}, Eigen::Vector3d::UnitX(), -0.1, 0.2);
  add_joint("disk", JointType::continuous, {0.1, 0.15, 0.03}, Eigen::Vector3d::UnitZ(), -infinity,
            infinity);
  return tree;
}

}  // namespace lockbox::testing
