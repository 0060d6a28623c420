// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "lockbox/terms/term_options.hpp"

namespace lockbox {

/// Weights and gates of E = E_model + lambda_free E_free + lambda_collision E_collision
/// (docs/mathematics.md).
struct RegistrationOptions : TermOptions, CollisionOptions {
  /// Linearisations of a frame; more follow while surfaces still move. Unit: iterations. Source:
  /// predictions are good at 30 frames a second.
  int max_iterations = 3;
  /// Points of an image that are used, at most about, chosen for what they tell. From a prediction,
  /// means of pixels where faces are flat, so that few are needed. A cloud without an image is used
  /// whole. 0: all. Unit: points. Source: as exact as 40,000 within 6 %, in two thirds of the time
  /// (docs/benchmarks.md).
  std::size_t point_budget = 20000;

  /// As noise_correlation, of pixels of a contour, in the refinement: there each errs almost
  /// by itself. Unit: pixels. Source: docs/mathematics.md; 1 to 3.3 do
  /// nearly the same.
  double contour_correlation = 2.0;

  /// Look for joints whose parts do not stand out of the noise in the image itself
  /// (low_prominence.hpp). Source: docs/mathematics.md.
  bool match_low_prominence = true;

  /// Take a last step by the likelihood of the image at the model's own edges (edge_term.hpp),
  /// unless the point budget is below 1,000. Source: docs/mathematics.md.
  bool refine_at_edges = true;

  /// The base does not move. Source: the user's, `--fixed-base`.
  bool fixed_base = false;
  /// Joint variables that are held, one value for each. Empty: none. Source: the user's,
  /// `--lock-joint`.
  std::vector<bool> locked;

  /// Converged when a step moves no point of the model farther. Unit: metres. Source: a tenth of
  /// what noise lets an estimate err.
  double step_tolerance = 2e-5;

  /// Says whether the joint variable is held.
  bool is_locked(int variable) const {
    const auto index = static_cast<std::size_t>(variable);
    return index < locked.size() && locked[index];
  }

  /// Returns those of so many joint variables that are not locked.
  std::vector<int> free_variables(int variables) const {
    std::vector<int> free;
    for (int v = 0; v < variables; ++v) {
      if (!is_locked(v)) free.push_back(v);
    }
    return free;
  }
};

}  // namespace lockbox
