// SPDX-License-Identifier: BSD-3-Clause
// What follows from the numbers of a simulated sensor.
#pragma once

#include <string>
#include <vector>

#include "lockbox/core/pinhole_camera.hpp"
#include "lockbox/sensor/sensor_model.hpp"

namespace lockbox {

/// Returns the simulated side of the profile that find_sensor_profile() knows by this name or file.
/// Throws InputError, too where the profile does not say how to simulate the sensor.
SensorModel sensor_model(const std::string& name_or_file);

/// Returns the standard deviation of the white noise at that depth on a surface that faces the
/// sensor, metres.
double white_depth_noise(const SensorModel& sensor, double z);

/// Returns the standard deviation of a measured depth around z (metres) on a surface that faces the
/// sensor: disparity noise and both roundings, lateral jitter not included.
double depth_sigma(const SensorModel& sensor, const PinholeCamera& camera, double z);

/// Returns the filter, along rows and along columns, that gives white noise of unit variance the
/// correlation of the sensor's and leaves its variance as it is: 2 radius + 1 taps.
std::vector<float> correlation_kernel(const SensorModel& sensor);

/// Returns the sum of the disparity noise's autocorrelation over all offsets, in pixels: the mean
/// of n neighbouring pixels' noise has the variance of n / correlation_area independent ones. 1 for
/// white noise, about 2 pi L^2 otherwise.
double correlation_area(const SensorModel& sensor);

}  // namespace lockbox
