// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/unknowns.hpp"

namespace lockbox {

std::vector<std::string> unknown_names(const KinematicTree& tree) {
  std::vector<std::string> names{"tx", "ty", "tz", "rx", "ry", "rz"};
  for (const int joint : tree.variable_joint) {
    names.push_back(tree.joints[static_cast<std::size_t>(joint)].name);
  }
  return names;
}

bool is_length(const KinematicTree& tree, int unknown) {
  if (unknown < kBaseUnknowns) return unknown < 3;
  const int joint = tree.variable_joint[static_cast<std::size_t>(unknown - kBaseUnknowns)];
  return tree.joints[static_cast<std::size_t>(joint)].type == JointType::prismatic;
}

}  // namespace lockbox
