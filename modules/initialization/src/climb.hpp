// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "lockbox/core/parallel.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "view_score.hpp"

namespace lockbox {

/// Moves base and joints, one unknown after the other, to where the drawn model fits the view best:
/// by a few millimetres of its surfaces at first, then by ever smaller steps. What is seen beside
/// the model counts against a drawing, so that a wall just behind cannot pull it away. scores: of
/// the same view, one for each worker of the executor.
void climb(const KinematicTree& tree, std::vector<ViewScore>& scores, const Executor& executor,
           Configuration& configuration);

}  // namespace lockbox
