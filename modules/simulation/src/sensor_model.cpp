// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/simulation/sensor_model.hpp"

#include <cmath>
#include <numbers>
#include <numeric>

#include "lockbox/core/error.hpp"
#include "lockbox/sensor/sensor_profile.hpp"

namespace lockbox {
namespace {

constexpr double kMillimetre = 0.001;

}  // namespace

SensorModel sensor_model(const std::string& name_or_file) {
  const SensorProfile profile = find_sensor_profile(name_or_file);
  if (!profile.simulated) {
    throw InputError(profile.file.string(),
                     "does not say how to simulate this sensor; add `simulation:`, or `like:` and "
                     "the name of one that can be simulated");
  }
  return *profile.simulated;
}

double white_depth_noise(const SensorModel& sensor, double z) {
  const double beyond = z - sensor.depth_noise_reference;
  return sensor.depth_noise + sensor.depth_noise_growth * beyond * beyond;
}

double depth_sigma(const SensorModel& sensor, const PinholeCamera& camera, double z) {
  const double metres_per_pixel = z * z / (camera.fx * sensor.baseline);
  const double disparity = metres_per_pixel * std::hypot(sensor.disparity_noise,
                                                         sensor.disparity_step / std::sqrt(12.0));
  return std::hypot(disparity, white_depth_noise(sensor, z), kMillimetre / std::sqrt(12.0));
}

std::vector<float> correlation_kernel(const SensorModel& sensor) {
  // A Gaussian filter's own autocorrelation is a Gaussian of sqrt(2) times its width.
  const double width = sensor.correlation_length / std::numbers::sqrt2;
  const int radius = static_cast<int>(std::ceil(3.0 * width));
  std::vector<double> taps;
  for (int i = -radius; i <= radius; ++i) {
    taps.push_back(radius > 0 ? std::exp(-0.5 * (i / width) * (i / width)) : 1.0);
  }
  const double norm = std::sqrt(std::inner_product(taps.begin(), taps.end(), taps.begin(), 0.0));
  std::vector<float> kernel;
  kernel.reserve(taps.size());
  for (const double tap : taps) {
    kernel.push_back(static_cast<float>(tap / norm));
  }
  return kernel;
}

double correlation_area(const SensorModel& sensor) {
  const std::vector<float> kernel = correlation_kernel(sensor);
  const double sum = std::accumulate(kernel.begin(), kernel.end(), 0.0);
  return std::pow(sum, 4);
}

}  // namespace lockbox
