// SPDX-License-Identifier: BSD-3-Clause
// Random numbers that follow from what they are for: a seed, a frame, a row.
#pragma once

#include <array>
#include <cstdint>

namespace lockbox::simulation {

/// SplitMix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number generators", 2014).
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::uint64_t frame, std::uint64_t row, std::uint64_t purpose)
      : state_(mixed(mixed(mixed(mixed(seed) + frame) + row) + purpose)) {}

  /// 64 independent random bits.
  std::uint64_t next() { return mixed(state_ += kGamma); }

 private:
  static constexpr std::uint64_t kGamma = 0x9e3779b97f4a7c15U;

  static std::uint64_t mixed(std::uint64_t z) {
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31U);
  }

  std::uint64_t state_;
};

/// Normal deviates of unit variance by look-up: the quantiles of 4096 equally likely classes. Exact
/// in mean and variance; the largest is 3.7 standard deviations.
class NormalTable {
 public:
  NormalTable();

  /// Draws from the 12 lowest bits.
  float operator()(std::uint64_t bits) const { return quantiles_[bits & 0xfffU]; }

  /// Draws from the 24 lowest bits: the scaled sum of two, which reaches 5 standard deviations.
  float long_tailed(std::uint64_t bits) const {
    return 0.70710678F * ((*this)(bits) + (*this)(bits >> 12U));
  }

 private:
  std::array<float, 4096> quantiles_;
};

}  // namespace lockbox::simulation
