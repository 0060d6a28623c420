// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>

#include "lockbox/sensor/noise_record.hpp"

namespace lockbox {

/// Returns the bin of a depth in metres: each reaches farther by the same factor, the last one to 7
/// m.
inline std::optional<std::size_t> depth_bin(double z) {
  constexpr double kNearest = 0.2;  // metres
  constexpr double kGrowth = 1.25;
  if (z < kNearest) return std::nullopt;
  const auto bin = static_cast<std::size_t>(std::log(z / kNearest) / std::log(kGrowth));
  return bin < NoiseRecord::kBins ? std::optional(bin) : std::nullopt;
}

}  // namespace lockbox
