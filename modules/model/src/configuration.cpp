// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/model/configuration.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lockbox/core/error.hpp"

namespace lockbox {
namespace {

const Joint& joint_at(const KinematicTree& tree, int joint) {
  return tree.joints[static_cast<std::size_t>(joint)];
}

}  // namespace

Configuration rest_configuration(const KinematicTree& tree) {
  Configuration rest;
  rest.q.resize(tree.variables());
  for (int v = 0; v < tree.variables(); ++v) {
    const VariableLimits limits = variable_limits(tree, v);
    rest.q[v] = std::clamp(0.0, limits.lower, limits.upper);
  }
  return rest;
}

Configuration unknown_configuration(const KinematicTree& tree) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  Configuration unknown;
  unknown.T_camera_base.matrix().topRows<3>().setConstant(kNan);
  unknown.q.setConstant(tree.variables(), kNan);
  return unknown;
}

int joint_index(const KinematicTree& tree, const std::string& joint_name) {
  std::string names;
  for (std::size_t j = 0; j < tree.joints.size(); ++j) {
    if (tree.joints[j].name == joint_name) return static_cast<int>(j);
  }
  for (const Joint& joint : tree.joints) names += (names.empty() ? "" : ", ") + joint.name;
  throw InputError("joint '" + joint_name + "'",
                   names.empty() ? "the model has no joints" : "no such joint; there are " + names);
}

double joint_position(const KinematicTree& tree, const Configuration& configuration, int joint) {
  const Joint& j = joint_at(tree, joint);
  return j.multiplier * configuration.q[j.variable] + j.offset;
}

void set_joint_position(const KinematicTree& tree, Configuration& configuration,
                        const std::string& joint_name, double position) {
  const Joint& joint = joint_at(tree, joint_index(tree, joint_name));
  if (joint.is_mimic) {
    const int driver = tree.variable_joint[static_cast<std::size_t>(joint.variable)];
    throw InputError("joint '" + joint_name + "'",
                     "cannot be set, it mimics; set '" + joint_at(tree, driver).name + "'");
  }
  if (!std::isfinite(position)) {
    throw InputError("joint '" + joint_name + "'", "a position must be a finite number");
  }
  configuration.q[joint.variable] = position;
}

VariableLimits variable_limits(const KinematicTree& tree, int variable) {
  const Joint& joint = joint_at(tree, tree.variable_joint[static_cast<std::size_t>(variable)]);
  return {joint.lower, joint.upper};
}

}  // namespace lockbox
