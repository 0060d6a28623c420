// SPDX-License-Identifier: BSD-3-Clause
#include "image_belief.hpp"

#include "lockbox/verification/belief.hpp"

namespace lockbox {

double ImageBelief::of(const Configuration& configuration) {
  verifier_.look_at(cloud_, options_.registration.noise.sigma_inverse_depth(), executor_);
  return belief(verifier_.evidence(configuration).total(), {});
}

}  // namespace lockbox
