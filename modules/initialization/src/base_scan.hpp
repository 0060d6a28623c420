// SPDX-License-Identifier: BSD-3-Clause
// The base, sought about a body that stays where it is (docs/verification.md, "Belief").
#pragma once

#include <vector>

#include "hypothesis.hpp"
#include "lockbox/core/parallel.hpp"
#include "lockbox/verification/agreement.hpp"
#include "search_image.hpp"
#include "sought_model.hpp"

namespace lockbox {

/// What is seen of an answer may be a door for the most part, and stand where the door does with
/// its hinge at any angle: all that tells is how little there is of a carcass. So the base swings
/// about each body of which more is seen than of it, and is taken where most is explained of both,
/// unless it is there already. held: in which all other joints stand. bodies: how each body of the
/// answer compares with the image.
std::vector<Hypothesis> with_base_swung(SearchImage& image, const SoughtModel& sought,
                                        const Configuration& held, const Configuration& answer,
                                        const std::vector<Agreement>& bodies,
                                        const Executor& executor);

}  // namespace lockbox
