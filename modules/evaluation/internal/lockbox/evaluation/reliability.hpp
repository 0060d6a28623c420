// SPDX-License-Identifier: BSD-3-Clause
// Whether answers that are believed by so much are right so often.
#pragma once

#include <cstddef>
#include <vector>

namespace lockbox {

/// What was said of one independent run, and what is true.
struct StatedBelief {
  double belief = 0.0;      ///< 0 to 1
  bool is_trusted = false;  ///< called `tracking`
  bool is_right = false;
};

struct Interval {
  double lower = 0.0;
  double upper = 1.0;
};

/// Returns where the true share lies, of one that was observed as `hits` of `runs`, in 95 of 100
/// cases (Wilson, 1927, https://doi.org/10.1080/01621459.1927.10502953). (0, 1) without a run.
Interval wilson_interval(std::size_t hits, std::size_t runs);

/// The runs whose belief lies from `lower` to below `upper`.
struct ReliabilityBin {
  double lower = 0.0;
  double upper = 0.0;
  std::size_t runs = 0;
  std::size_t right = 0;
  double mean_belief = 0.0;  ///< of the runs; 0 without one
  Interval observed;         ///< of the share that is right

  /// Bins of fewer runs than 30 tell nothing, and hold.
  bool holds() const;
};

/// Penalties a run in the mean: the smaller, the better.
struct Scores {
  double brier = 0.0;     ///< squared difference of belief and truth (Brier, 1950)
  double log_loss = 0.0;  ///< -log of the probability that was given to what is true, nats
};

/// Bins [0, .1) to [.8, .9), [.9, .99), [.99, .999), [.999, 1].
std::vector<ReliabilityBin> reliability_bins(const std::vector<StatedBelief>& runs);

/// Returns the scores of the beliefs as stated.
Scores scores_of_belief(const std::vector<StatedBelief>& runs);
/// Returns the scores as if every run were believed by the share of all that are right.
Scores scores_of_constant(const std::vector<StatedBelief>& runs);
/// Returns the scores as if the status alone were known: the share of those with the same status
/// that are right.
Scores scores_of_status(const std::vector<StatedBelief>& runs);

}  // namespace lockbox
