// SPDX-License-Identifier: BSD-3-Clause
#include "image_belief.hpp"

#include "lockbox/verification/belief.hpp"

namespace lockbox {

double ImageBelief::of(const Configuration& configuration) {
  return belief(evidence({&configuration, 1}).front(), {}, options_.evidence);
}

std::vector<double> ImageBelief::evidence(std::span<const Configuration> configurations) {
  verifier_.look_at(cloud_, options_.registration.noise, executor_);
  std::vector<double> nats;
  for (const Configuration& configuration : configurations) {
    nats.push_back(verifier_.evidence_within_tolerance(configuration).total());
  }
  return nats;
}

}  // namespace lockbox
