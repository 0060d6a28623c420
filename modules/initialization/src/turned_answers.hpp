// SPDX-License-Identifier: BSD-3-Clause
// What else the object may be that was taken for an answer (docs/verification.md, "Belief").
#pragma once

#include <vector>

#include "lockbox/verification/agreement.hpp"
#include "sought_model.hpp"

namespace lockbox {

/// The answer turned to where the model's box is the same, or its base, swung about what is seen
/// most of, and moved to where one of its parts passes for another one. held: in which joints stand
/// that are still to be sought. bodies: how each body of the answer compares with the image.
std::vector<Hypothesis> turned_answers(const SoughtModel& sought, const Configuration& held,
                                       const Configuration& answer,
                                       const std::vector<Agreement>& bodies);

/// The answer turned to where most of its base is the same, since it is round, and by little. They
/// look so much like it, all of them, that they are compared apart from others.
std::vector<Hypothesis> turned_about_round(const SoughtModel& sought, const Configuration& held,
                                           const Configuration& answer);

}  // namespace lockbox
