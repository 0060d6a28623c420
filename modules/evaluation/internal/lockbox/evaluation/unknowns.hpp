// SPDX-License-Identifier: BSD-3-Clause
// The unknowns of a frame: the base's twist (v, w) in the base's frame, then the joint variables.
#pragma once

#include <string>
#include <vector>

#include "lockbox/model/kinematic_tree.hpp"

namespace lockbox {

/// tx ty tz rx ry rz, then the joints that the variables belong to.
std::vector<std::string> unknown_names(const KinematicTree& tree);

/// Whether the unknown is measured in metres, not in radians.
bool is_length(const KinematicTree& tree, int unknown);

}  // namespace lockbox
