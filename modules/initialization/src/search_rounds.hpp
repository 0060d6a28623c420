// SPDX-License-Identifier: BSD-3-Clause
// The rounds of the search without a guess (docs/initialization.md): each looks closer than those
// before, and is left out where these have convinced.
#pragma once

#include <vector>

#include "assessment.hpp"
#include "exact_fit.hpp"
#include "proposer.hpp"
#include "refinement.hpp"
#include "search_image.hpp"

namespace lockbox {

enum class Proposals {
  sides,             ///< flat sides of the model on planes of the view
  sides_closer,      ///< likewise, on planes of the finer view
  all_sides,         ///< on planes of both
  points,            ///< pairs of points, of the body that tells most
  points_of_others,  ///< of the other bodies that tell
};

/// A part of the search. Each looks closer than those before.
struct Round {
  Proposals proposals;
  const Breadth* breadth;
  std::size_t first;  ///< hypotheses that are followed before all others
  double enough;      ///< belief in an answer, with which the search ends
};

/// Proposes, refines, and assesses. Not thread-safe; throws Stopped if that is requested.
class SearchRounds {
 public:
  /// What is sought, and the fit, must outlive it.
  SearchRounds(const SoughtModel& sought, const InitializerOptions& options, ExactFit& exact,
               const Executor& executor);

  /// All stages but the last, round by round, until an answer is convincing. The answers of all
  /// rounds are ranked together. Locked joints stand as in `held`.
  std::vector<Candidate> seek(SearchImage& image, const Configuration& held, int most_rounds,
                              SearchProgress& progress);

  /// Returns the assessment of the image that was sought in last.
  Assessment& assessment() { return assessment_; }

 private:
  std::vector<Hypothesis> proposed(SearchImage& image, const Configuration& held,
                                   const Round& round);
  /// Answers of rounds before.
  std::vector<Hypothesis> known(const std::vector<Configuration>& answers) const;
  /// The stages from place up to rank, of what was not followed before in this image. held: where
  /// joints stand that are not sought; to_beat: the most evidence of any answer up to now, nats.
  std::vector<Hypothesis> followed(SearchImage& image, std::vector<Hypothesis> hypotheses,
                                   const Configuration& held, const Breadth& breadth,
                                   double to_beat);
  void leave_out_followed(std::vector<Hypothesis>& hypotheses);
  void seek_turns_of_best(SearchImage& image, const Configuration& held, double& turned,
                          std::vector<Candidate>& answers);

  const SoughtModel& sought_;
  std::size_t most_candidates_;
  Executor executor_;
  ExactFit& exact_;
  Proposer proposer_;
  Refinement refinement_;
  Assessment assessment_;
  std::vector<Hypothesis> posed_;  ///< what was followed in this image, as `pose` left it
};

}  // namespace lockbox
