// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "lockbox/terms/term_options.hpp"

namespace lockbox {

/// Weights and gates of E = E_model + lambda_free E_free + lambda_collision E_collision
/// (docs/mathematics.md).
struct RegistrationOptions : TermOptions, CollisionOptions {
  int max_iterations = 3;  ///< linearisations
  /// Points of an image that are used, at most about, chosen for what they tell; 0: all. From a
  /// prediction, means of pixels where faces are flat, so that few are needed. A cloud without an
  /// image is used whole.
  std::size_t point_budget = 20000;

  /// As noise_correlation, of pixels of an outline, in the last step: there each is a witness
  /// almost by itself.
  double outline_correlation = 2.0;

  /// Look for joints whose parts do not stand out of the noise in the image itself
  /// (low_relief.hpp).
  bool sight_low_relief = true;

  /// Take a last step by the likelihood of the image at the model's own edges (edge_term.hpp),
  /// unless the point budget is below 1,000.
  bool refine_at_edges = true;

  bool fixed_base = false;
  std::vector<bool> locked;  ///< by joint variable; empty: none

  /// Converged when a step moves no point of the model farther than this, metres.
  double step_tolerance = 2e-5;

  bool is_locked(int variable) const {
    const auto index = static_cast<std::size_t>(variable);
    return index < locked.size() && locked[index];
  }

  /// Of so many joint variables those that are not locked.
  std::vector<int> free_variables(int variables) const {
    std::vector<int> free;
    for (int v = 0; v < variables; ++v) {
      if (!is_locked(v)) free.push_back(v);
    }
    return free;
  }
};

}  // namespace lockbox
