// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/sensor/sensor_noise.hpp"

#include <algorithm>
#include <numbers>

#include "lockbox/core/square.hpp"

namespace lockbox {

double SensorNoise::correlation_area() const {
  const double shared = 1.0 - square(own_share);
  const double alike = 2.0 * std::numbers::pi * square(correlation_pixels);
  return square(own_share) + shared * std::max(1.0, alike);
}

}  // namespace lockbox
