// SPDX-License-Identifier: BSD-3-Clause
// What a depth sensor does to the true depth, as numbers.
//
// A pixel looks not through its centre but through a point that jitters around it. There it sees
// the depth z, that is the disparity d = fx baseline / z, to which noise is added before it is
// rounded to a multiple of the step; the depth fx baseline / d comes out in whole millimetres.
#pragma once

#include <string>
#include <vector>

#include "lockbox/core/pinhole_camera.hpp"

namespace lockbox {

struct SensorModel {
  std::string name;
  double baseline = 0.075;          ///< metres; disparity = camera.fx * baseline / z
  double disparity_noise = 0.0;     ///< standard deviation, pixels
  double disparity_step = 0.0;      ///< pixels; 0: disparity is not rounded
  double correlation_length = 0.0;  ///< L, pixels: disparity noise r pixels apart correlates as
                                    ///< exp(-r^2 / (2 L^2)); 0: not at all
  double lateral_jitter = 0.0;  ///< standard deviation along each axis, pixels; each pixel's own
  double depth_noise = 0.0;     ///< white noise of z: standard deviation at 0.4 m, metres, ...
  double depth_noise_growth = 0.0;  ///< ... and its growth with (z - 0.4 m)^2, 1/metres
  double dropout_rate = 0.0;        ///< share of pixels without measurement
  double edge_dropout_rate = 0.0;   ///< the same next to a jump of the disparity by over 1 pixel
  double grazing_angle = 1.570796;  ///< incidence, radians, from which on drop-outs grow to all of
                                    ///< the pixels at 90 degrees, linearly in the cosine
  bool has_projector_shadow = false;  ///< nothing is measured where the projector, at x = baseline
                                      ///< of the camera's frame, is hidden by something nearer
  double min_range = 0.0;             ///< metres; what is measured nearer or farther is dropped
  double max_range = 65.535;
};

/// The model of that name, one of sensor_names(). Throws InputError.
SensorModel sensor_model(const std::string& name);

/// `primesense`, `primesense-quiet`, `structured-light`, `white` and `ideal`, as a sentence has it.
std::string sensor_names();

/// Standard deviation of a measured depth around z (metres) on a surface that faces the sensor:
/// disparity noise and both roundings, lateral jitter not included.
double depth_sigma(const SensorModel& sensor, const PinholeCamera& camera, double z);

/// The filter, along rows and along columns, that gives white noise of unit variance the
/// correlation of the sensor's and leaves its variance as it is: 2 radius + 1 taps.
std::vector<float> correlation_kernel(const SensorModel& sensor);

/// The sum of the disparity noise's autocorrelation over all offsets, in pixels: the mean of n
/// neighbouring pixels' noise has the variance of n / correlation_area independent ones. 1 for
/// white noise, about 2 pi L^2 otherwise.
double correlation_area(const SensorModel& sensor);

}  // namespace lockbox
