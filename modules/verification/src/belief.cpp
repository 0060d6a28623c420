// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/verification/belief.hpp"

#include <cmath>

namespace lockbox {

double least_evidence(const EvidenceOptions& options) {
  return options.places;
}

double evidence_beyond_a_box(const EvidenceOptions& options) {
  return options.beyond_a_box * least_evidence(options);
}

double log_odds(double evidence, double against, const EvidenceOptions& options) {
  return (evidence - against) / options.alike;
}

double belief(double evidence, std::span<const double> of_others, const EvidenceOptions& options) {
  double odds_against = std::exp(log_odds(least_evidence(options), evidence, options));
  for (const double other : of_others) odds_against += std::exp(log_odds(other, evidence, options));
  return 1.0 / (1.0 + odds_against);
}

}  // namespace lockbox
