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

}  // namespace lockbox
