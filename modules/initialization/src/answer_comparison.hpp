// SPDX-License-Identifier: BSD-3-Clause
// Which of the search's answers is the best, where some of them speak of the same pixels.
#pragma once

#include <cstdint>
#include <vector>

#include "hypothesis.hpp"
#include "lockbox/initialization/initializer.hpp"

namespace lockbox {

/// Wrong answers mostly score less, right ones only of what is small, far away or mostly hidden:
/// then more is kept of what says little.
inline constexpr double kPossible = 28.0;

inline constexpr double kSamePlace = 1.0;  ///< radii: most of the pixels are the same

/// A candidate with what it is compared by.
struct Answer {
  Candidate candidate;
  double total;                         ///< of the evidence
  std::vector<std::uint8_t> explained;  ///< by pixel of the view, the same for all answers
};

/// Puts the best answer first. Of those that compete for the same pixels the one that explains most
/// is the best, or of those that explain about as much the one that scores most, and the scores of
/// others become their share of what it explains. Answers that do not compete are compared by
/// score, how convincing they are.
void sort_best_first(std::vector<Answer>& answers, const ModelLevers& levers);

/// See Candidate::rival_distance. answers: best first.
double rival_distance(const std::vector<Answer>& answers, const ModelLevers& levers);

}  // namespace lockbox
