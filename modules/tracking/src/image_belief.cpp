// SPDX-License-Identifier: BSD-3-Clause
#include "image_belief.hpp"

#include "lockbox/verification/belief.hpp"

namespace lockbox {

double ImageBelief::of(const Configuration& configuration) {
  verifier_.look_at(cloud_, options_.registration.noise, executor_);
  const Evidence evidence = verifier_.evidence_within_tolerance(configuration);
  return belief(evidence.total(), {}, options_.evidence);
}

std::vector<double> ImageBelief::evidence(std::span<const Configuration> rivals) {
  return verifier_.compare(cloud_, options_.registration.noise, executor_, rivals);
}

}  // namespace lockbox
