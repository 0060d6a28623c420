// SPDX-License-Identifier: BSD-3-Clause
// Frames of simple scenes as a sensor measures them.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <set>

#include "lockbox/simulation/sensor_simulator.hpp"

namespace lockbox {

inline const PinholeCamera kSimulatedCamera{640, 480, 575.8, 575.8, 319.5, 239.5};
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Clean depth for the simulator: z(u, v) at every sample, u and v in pixels.
inline RenderedDepth clean_depth(const SensorSimulator& simulator,
                                 const std::function<double(double, double)>& z) {
  const PinholeCamera& camera = simulator.sample_camera();
  RenderedDepth image{camera.width, camera.height, {}, {}, {0, 0, camera.width, camera.height}};
  const double step = kSimulatedCamera.fx / camera.fx;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      image.depth.push_back(static_cast<float>(z(u * step, v * step)));
    }
  }
  image.id.assign(image.depth.size(), 0);
  return image;
}

inline DepthFrame measured(const SensorModel& sensor,
                           const std::function<double(double, double)>& z, std::uint64_t index = 0,
                           int threads = 2, std::uint64_t seed = 1) {
  SensorSimulator simulator(sensor, kSimulatedCamera, seed, Executor(threads));
  DepthFrame frame;
  simulator.measure(clean_depth(simulator, z), index, frame);
  return frame;
}

inline double flat_wall(double, double) {
  return 1.2;
}

/// The share of pixels with v in the middle half of the image and u in [begin, end) without depth.
inline double share_without_depth(const DepthFrame& frame, int begin, int end) {
  int missing = 0;
  for (int v = 120; v < 360; ++v) {
    for (int u = begin; u < end; ++u) {
      missing += frame.metres(u, v) == 0.0F ? 1 : 0;
    }
  }
  return missing / (240.0 * (end - begin));
}

// The plane x sin(a) - (z - 1.2) cos(a) = 0 turned about the y axis by the incidence a at the
// image's centre: z = 1.2 / (1 - tan(a) (u - cx) / fx).
inline double slanted_wall(double degrees, double u) {
  const double slope = std::tan(degrees / 180.0 * std::numbers::pi);
  const double z = 1.2 / (1.0 - slope * (u - kSimulatedCamera.cx) / kSimulatedCamera.fx);
  return z > 0.0 ? z : kInfinity;
}

inline double share_without_depth_at_incidence(double degrees, const char* sensor = "primesense") {
  const DepthFrame frame = measured(
      sensor_model(sensor), [degrees](double u, double) { return slanted_wall(degrees, u); });
  return share_without_depth(frame, 319, 321);
}

/// The columns of a row in the image's middle without depth.
inline std::set<int> unmeasured_columns(const DepthFrame& frame) {
  std::set<int> columns;
  for (int u = 0; u < kSimulatedCamera.width; ++u) {
    if (frame.metres(u, 240) == 0.0F) columns.insert(u);
  }
  return columns;
}

}  // namespace lockbox
