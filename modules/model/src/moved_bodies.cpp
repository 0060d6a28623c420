// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/model/moved_bodies.hpp"

namespace lockbox {

std::vector<std::uint8_t> moved_bodies(const KinematicTree& tree, int variable) {
  std::vector<std::uint8_t> moved(tree.bodies.size(), 0);
  for (const Joint& joint : tree.joints) {  // parents come before children
    const bool is_carried = moved[static_cast<std::size_t>(joint.parent_body)] != 0;
    moved[static_cast<std::size_t>(joint.child_body)] =
        joint.variable == variable || is_carried ? 1 : 0;
  }
  return moved;
}

}  // namespace lockbox
