// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>

namespace lockbox {

/// The same numbers everywhere: the distributions of the standard library are not specified.
class RandomDraws {
 public:
  /// Draws of different numbers are independent.
  RandomDraws(std::uint64_t seed, std::uint64_t number);

  double uniform(double low, double high);
  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }

  /// Coordinates between those of low and high. The last one is drawn first: arguments that draw
  /// are evaluated in an order of the compiler's.
  Eigen::Vector3d uniform(const Eigen::Vector3d& low, const Eigen::Vector3d& high);

  /// A unit vector, all directions alike.
  Eigen::Vector3d direction();

 private:
  std::mt19937_64 engine_;
};

}  // namespace lockbox
