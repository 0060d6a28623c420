// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lockbox/sensor/sensor_noise.hpp"

namespace lockbox {

/// How measurements are compared with what the model is predicted to show.
struct ViewOptions {
  SensorNoise noise;  ///< what the sensor is assumed to err by
  /// Residuals beyond it count as outliers. Unit: standard deviations. Source: of normal errors one
  /// in 16,000 is beyond it.
  double gate = 4.0;
  /// A measurement less far behind the model's surface does not see through it. Without it the
  /// term, which has one side only, would push the model off the cloud. Unit: standard deviations
  /// along the ray. Source: of normal errors one in 740 is beyond it.
  double free_space_tolerance = 3.0;
  /// Neighbouring pixels err alike: the information in N of them is that of N / correlation. Unit:
  /// pixels. Source: the demo, where the mean squared normalised error of joints is 0.4 with it;
  /// with half of it noise counts as misfit, and that is 0.1; with double a door errs an eighth
  /// more. A sensor's profile replaces it.
  double noise_correlation = 20.0;
};

}  // namespace lockbox
