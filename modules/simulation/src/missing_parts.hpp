// SPDX-License-Identifier: BSD-3-Clause
// Parts that a model has, and the object has not.
#pragma once

#include <string>
#include <vector>

#include "lockbox/model/kinematic_tree.hpp"
#include "lockbox/simulation/random_draws.hpp"

namespace lockbox::simulation {

/// Takes the meshes of the bodies with these links, and of all that they carry. Throws InputError
/// for a link that there is not, and for the base.
void take_parts(KinematicTree& tree, const std::vector<std::string>& links);

/// Takes so many handles (see count_handles()). Throws InputError if there are fewer.
void take_handles(KinematicTree& tree, int count, RandomDraws& random);

}  // namespace lockbox::simulation
