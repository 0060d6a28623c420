// SPDX-License-Identifier: BSD-3-Clause
// Kinematic trees without shape, for tests of what depends on joints only.
#pragma once

#include <limits>
#include <random>
#include <string>
#include <vector>

#include "lockbox/core/lie.hpp"
#include "lockbox/model/kinematic_tree.hpp"

namespace lockbox {

/// Adds a body below parent_body, with a joint between them that has a variable of its own.
inline Joint& add_joint(KinematicTree& tree, int parent_body, JointType type,
                        const Eigen::Isometry3d& T_parent_joint, const Eigen::Vector3d& axis) {
  if (tree.bodies.empty()) tree.bodies.emplace_back().name = "base";
  const int j = static_cast<int>(tree.joints.size());
  Joint joint;
  joint.name = "joint" + std::to_string(j);
  joint.type = type;
  joint.parent_body = parent_body;
  joint.child_body = j + 1;
  joint.T_parent_joint = T_parent_joint;
  joint.axis = axis.normalized();
  joint.lower = type == JointType::continuous ? -std::numeric_limits<double>::infinity() : -2.0;
  joint.upper = -joint.lower;
  joint.variable = tree.variables();
  tree.variable_joint.push_back(j);
  tree.file_order.push_back(j);
  Body& body = tree.bodies.emplace_back();
  body.name = "body" + std::to_string(j + 1);
  body.parent_joint = j;
  return tree.joints.emplace_back(joint);
}

/// Makes the last joint follow variable v: position = multiplier * variable + offset.
inline void make_last_a_mimic(KinematicTree& tree, int v, double multiplier, double offset) {
  Joint& joint = tree.joints.back();
  tree.variable_joint.pop_back();
  joint.variable = v;
  joint.is_mimic = true;
  joint.multiplier = multiplier;
  joint.offset = offset;
}

inline Eigen::Vector3d random_vector(std::mt19937& generator) {
  std::uniform_real_distribution<double> component(-1.0, 1.0);
  const double x = component(generator);
  const double y = component(generator);
  return {x, y, component(generator)};
}

inline Eigen::Isometry3d random_pose(std::mt19937& generator) {
  Twist twist;
  twist.head<3>() = random_vector(generator);
  twist.tail<3>() = 2.0 * random_vector(generator);
  return exp_se3(twist);
}

}  // namespace lockbox
