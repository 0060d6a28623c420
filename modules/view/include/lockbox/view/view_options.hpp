// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lockbox/sensor/sensor_noise.hpp"

namespace lockbox {

/// How measurements are compared with what the model is predicted to show.
struct ViewOptions {
  SensorNoise noise;
  double cut = 4.0;  ///< residuals beyond this many standard deviations count as outliers
  double free_space_dead_zone = 3.0;  ///< standard deviations along the ray
  /// Neighbouring pixels err alike; the information in N of them is that of N / correlation.
  double noise_correlation = 20.0;
};

}  // namespace lockbox
