// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/model/moved_bodies.hpp"

namespace lockbox {

std::vector<std::uint8_t> moved_bodies(const KinematicTree& tree, int variable, std::size_t held) {
  std::vector<std::uint8_t> moved(tree.bodies.size(), 0);
  std::vector<std::uint8_t> is_done(tree.bodies.size(), 0);
  is_done[held] = 1;
  for (std::size_t child = held; child != 0;) {  // from the held body up to the base
    const Joint& joint = tree.joints[child - 1];
    const auto parent = static_cast<std::size_t>(joint.parent_body);
    moved[parent] = joint.variable == variable ? 1 : moved[child];
    is_done[parent] = 1;
    child = parent;
  }
  for (const Joint& joint : tree.joints) {  // parents come before children
    const auto child = static_cast<std::size_t>(joint.child_body);
    if (is_done[child] != 0) continue;
    moved[child] =
        joint.variable == variable ? 1 : moved[static_cast<std::size_t>(joint.parent_body)];
  }
  return moved;
}

}  // namespace lockbox
