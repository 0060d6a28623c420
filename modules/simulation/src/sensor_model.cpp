// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/simulation/sensor_model.hpp"

#include <cmath>
#include <numbers>
#include <numeric>

#include "lockbox/core/error.hpp"

namespace lockbox {
namespace {

constexpr double kMillimetre = 0.001;

SensorModel primesense(const std::string& name, double disparity_noise) {
  SensorModel sensor;
  sensor.name = name;
  sensor.disparity_noise = disparity_noise;
  sensor.disparity_step = 0.125;
  sensor.correlation_length = 3.0;
  sensor.lateral_jitter = 0.5;
  sensor.dropout_rate = 0.002;
  sensor.edge_dropout_rate = 0.25;
  sensor.grazing_angle = 80.0 / 180.0 * std::numbers::pi;
  sensor.min_range = 0.4;
  sensor.max_range = 4.5;
  return sensor;
}

/// Fewer pixels are measured than by primesense, and edges stay where they are.
SensorModel structured_light(const std::string& name) {
  SensorModel sensor = primesense(name, 0.08);
  sensor.lateral_jitter = 0.0;
  sensor.dropout_rate = 0.02;
  sensor.edge_dropout_rate = 0.6;
  sensor.has_projector_shadow = true;
  return sensor;
}

/// Active stereo with the baseline of small cameras, which matches windows of 5 x 5 pixels.
SensorModel stereo(const std::string& name) {
  SensorModel sensor;
  sensor.name = name;
  sensor.baseline = 0.05;
  sensor.disparity_noise = 0.08;
  sensor.disparity_step = 1.0 / 32.0;
  sensor.correlation_length = 2.0;
  sensor.matching_window = 5;
  sensor.least_fattening = 2.0;
  sensor.most_fattening = 4.0;
  sensor.hole_share = 0.01;
  sensor.dropout_rate = 0.002;
  sensor.grazing_angle = 80.0 / 180.0 * std::numbers::pi;
  sensor.min_range = 0.3;
  sensor.max_range = 6.0;
  return sensor;
}

/// The narrow field of view of an Azure Kinect, without binning.
SensorModel time_of_flight(const std::string& name, double slant_bias) {
  SensorModel sensor;
  sensor.name = name;
  sensor.camera = {640, 576, 504.0, 504.0, 319.5, 287.5};
  sensor.depth_noise = 0.0008;
  sensor.depth_noise_growth = 0.0007;
  sensor.depth_noise_reference = 0.0;
  sensor.is_weaker_when_slanted = true;
  sensor.slant_bias = slant_bias;
  sensor.mixes_depths = true;
  sensor.dropout_rate = 0.002;
  sensor.grazing_angle = 75.0 / 180.0 * std::numbers::pi;
  sensor.min_range = 0.3;
  sensor.max_range = 5.5;
  return sensor;
}

SensorModel white(const std::string& name) {
  SensorModel sensor;
  sensor.name = name;
  sensor.depth_noise = 0.0012;
  sensor.depth_noise_growth = 0.0019;
  sensor.min_range = 0.4;
  sensor.max_range = 4.5;
  return sensor;
}

}  // namespace

SensorModel sensor_model(const std::string& name) {
  if (name == "primesense") {
    return primesense(name, 0.08);
  }
  if (name == "primesense-quiet") {
    return primesense(name, 0.02);
  }
  if (name == "structured-light") {
    return structured_light(name);
  }
  if (name == "stereo") {
    return stereo(name);
  }
  if (name == "time-of-flight") {
    return time_of_flight(name, 0.006);
  }
  if (name == "time-of-flight-biased") {
    return time_of_flight(name, 0.020);
  }
  if (name == "white") {
    return white(name);
  }
  if (name == "ideal") {
    SensorModel ideal;
    ideal.name = name;
    return ideal;
  }
  throw InputError("sensor '" + name + "'", "unknown; choose " + sensor_names());
}

std::string sensor_names() {
  return "primesense, primesense-quiet, structured-light, stereo, time-of-flight, "
         "time-of-flight-biased, white or ideal";
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
