// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lockbox/core/parallel.hpp"
#include "lockbox/model/kinematic_tree.hpp"
#include "lockbox/simulation/deviation.hpp"

namespace lockbox {

/// The object as it was built: bodies and joints in the model's order, but without visuals. Its
/// base lies such that it fits the model's best (rigidly, least squares over the surface), so that
/// base pose and joint positions of the model are the truth of the object, too. Throws InputError
/// if the deviation names a link that the model does not have, or its base, or asks for more
/// handles or added parts than there is room for.
KinematicTree deviating_model(const KinematicTree& tree, const ObjectDeviation& deviation,
                              std::uint64_t seed, const Executor& executor);

/// The pieces of bodies that count as handles: shells that stand out of the rest of their body's
/// front (in the direction of the base's z axis at rest), those of moving bodies if there are any.
int count_handles(const KinematicTree& tree);

}  // namespace lockbox
