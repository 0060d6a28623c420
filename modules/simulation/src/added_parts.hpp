// SPDX-License-Identifier: BSD-3-Clause
// Parts that a model lacks: padlocks, cable channels, knobs.
#pragma once

#include "lockbox/core/parallel.hpp"
#include "lockbox/model/kinematic_tree.hpp"
#include "lockbox/simulation/random_draws.hpp"

namespace lockbox::simulation {

/// Puts parts onto the visible front of the object (its base's +z side, joints at rest), by turns
/// on the base and on a moving body: `count` of them, and more until they cover that share of its
/// view from the front. Throws InputError where that share cannot be covered.
void add_parts(KinematicTree& tree, int count, double share, RandomDraws& random,
               const Executor& executor);

}  // namespace lockbox::simulation
