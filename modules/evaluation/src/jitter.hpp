// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "lockbox/simulation/sensor_model.hpp"

namespace lockbox {

/// Standard deviation along each axis, in pixels, of where a pixel looks. Without lateral jitter an
/// edge still moves from one pixel to the next: as much as if a pixel looked anywhere in its
/// square.
inline double effective_jitter(const SensorModel& sensor) {
  constexpr double kPixelSquare = 0.2886751;  // 1 / sqrt(12)
  return std::max(sensor.lateral_jitter, kPixelSquare);
}

/// Pixels beyond this many standard deviations of jitter are not looked at.
inline constexpr double kJitterReach = 3.0;

}  // namespace lockbox
