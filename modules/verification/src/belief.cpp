// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/verification/belief.hpp"

#include <cmath>

#include "evidence_constants.hpp"

namespace lockbox {

double least_evidence() {
  return evidence::kPlaces;
}

double evidence_beyond_a_box() {
  return evidence::kBeyondABox * least_evidence();
}

double log_odds(double evidence, double against) {
  return (evidence - against) / evidence::kAlike;
}

double belief(double evidence, std::span<const double> of_others) {
  double odds_against = std::exp(log_odds(least_evidence(), evidence));
  for (const double other : of_others) odds_against += std::exp(log_odds(other, evidence));
  return 1.0 / (1.0 + odds_against);
}

}  // namespace lockbox
