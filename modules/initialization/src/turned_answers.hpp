// SPDX-License-Identifier: BSD-3-Clause
// What else the object may be that was taken for an answer (docs/verification.md, "Belief").
#pragma once

#include <vector>

#include "sought_model.hpp"

namespace lockbox {

/// The answer turned to where the model's box is the same, or its base, and moved to where one of
/// its parts passes for another one. held: in which joints stand that are still to be sought.
std::vector<Hypothesis> turned_answers(const SoughtModel& sought, const Configuration& held,
                                       const Configuration& answer);

/// The answer turned to where most of its base is the same, since it is round, and by little. They
/// look so much like it, all of them, that they are compared apart from others.
std::vector<Hypothesis> turned_about_round(const SoughtModel& sought, const Configuration& held,
                                           const Configuration& answer);

}  // namespace lockbox
