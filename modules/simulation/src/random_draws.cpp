// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/simulation/random_draws.hpp"

#include <cmath>
#include <numbers>

namespace lockbox {

RandomDraws::RandomDraws(std::uint64_t seed, std::uint64_t number) {
  std::seed_seq sequence{seed, seed >> 32U, number, number >> 32U};
  engine_.seed(sequence);
}

double RandomDraws::uniform(double low, double high) {
  return low + (high - low) * static_cast<double>(engine_() >> 11U) * 0x1.0p-53;
}

Eigen::Vector3d RandomDraws::uniform(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  Eigen::Vector3d drawn;
  for (int i = 2; i >= 0; --i) drawn[i] = uniform(low[i], high[i]);
  return drawn;
}

Eigen::Vector3d RandomDraws::direction() {
  const double z = uniform(-1.0, 1.0);
  const double angle = uniform(-std::numbers::pi, std::numbers::pi);
  const double r = std::sqrt(1.0 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

}  // namespace lockbox
