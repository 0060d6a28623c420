// SPDX-License-Identifier: BSD-3-Clause
// Which bodies may not reach into each other, and how much each is eroded before that is asked.
#pragma once

#include <vector>

#include "lockbox/terms/collision_term.hpp"

namespace lockbox {

/// All pairs of bodies with fields, but for those that a joint draws into each other; with the
/// overlaps that they have at rest. whole: the bodies' surfaces, not eroded. usual_erosion: metres.
std::vector<CollisionPair> find_collision_pairs(const ArticulatedModel& model,
                                                const std::vector<ErodedSurface>& whole,
                                                double usual_erosion, const Executor& executor);

/// Sets the erosion of each pair: the model file's, or the usual one (metres), half of the overlap
/// at rest added. Throws InputError naming the links if the file's would make a body vanish.
void choose_erosions(const ArticulatedModel& model, double usual,
                     std::vector<CollisionPair>& pairs);

}  // namespace lockbox
