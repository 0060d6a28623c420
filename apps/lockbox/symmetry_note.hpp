// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "lockbox/evaluation/equal_poses.hpp"
#include "lockbox/model/kinematic_tree.hpp"

namespace lockbox::app {

/// "the model looks the same turned by 180 degrees about x (axis of its base, through its
/// middle)", of a model that is equal to itself in other poses, with what joints have to do with
/// it.
std::string symmetry_text(const KinematicTree& tree, const EqualPoses& equal);

}  // namespace lockbox::app
