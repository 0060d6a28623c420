// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "lockbox/core/parallel.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "model_extent.hpp"
#include "view_score.hpp"

namespace lockbox {

struct CoordinateSearchPlan {
  std::vector<double> steps;  ///< metres that surfaces move, one size after the other
  int rounds;                 ///< over all unknowns with each of them, at most
  double slack;               ///< metres that surfaces may be off
};

/// Moves base and these joint variables, one unknown after the other, to where the drawn model fits
/// the view best: by large steps at first, then by ever smaller ones. What is seen beside the model
/// counts against a drawing, so that a wall just behind cannot pull it away, nor something that
/// stands before it. scores: of the same view, one for each worker of the executor.
void coordinate_search(const KinematicTree& tree, const ModelExtent& extent,
                       const std::vector<int>& variables, std::span<ViewScore> scores,
                       const Executor& executor, const CoordinateSearchPlan& plan,
                       Configuration& configuration);

}  // namespace lockbox
