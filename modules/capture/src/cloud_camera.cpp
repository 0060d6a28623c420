// SPDX-License-Identifier: BSD-3-Clause
#include "cloud_camera.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lockbox/core/error.hpp"
#include "lockbox/core/pinhole_fit.hpp"

namespace lockbox {
namespace {

constexpr double kMaximumDepth = 65535.0;  // units

bool is_measured(float z) {
  return std::isfinite(z) && z > 0.0F;
}

float depth_unit(const OrganizedCloud& cloud) {
  float farthest = 0.0F;
  bool whole = true;
  for (std::size_t i = 2; i < cloud.xyz.size(); i += 3) {
    const float z = cloud.xyz[i];
    if (is_measured(z)) {
      farthest = std::max(farthest, z);
      const double millimetres = double{z} * 1000.0;
      whole = whole && std::abs(millimetres - std::round(millimetres)) <= 1e-3;
    }
  }
  if (whole) {
    return 0.001F;
  }
  for (const float unit : {0.0001F, 0.00025F}) {
    if (double{farthest} <= kMaximumDepth * double{unit}) {
      return unit;
    }
  }
  return 0.001F;
}

}  // namespace

std::optional<PinholeCamera> recover_camera(const OrganizedCloud& cloud, const std::string& where) {
  PinholeFit fit;
  std::size_t i = 0;
  for (int v = 0; v < cloud.height; ++v) {
    for (int u = 0; u < cloud.width; ++u, i += 3) {
      fit.add(u, v, Eigen::Map<const Eigen::Vector3f>(&cloud.xyz[i]).cast<double>());
    }
  }
  if (!fit.is_determined()) {
    return std::nullopt;
  }
  if (!fit.is_pinhole()) {
    throw InputError(where,
                     "its points do not lie on the rays of a pinhole camera (z forward, x right, y "
                     "down); was the cloud transformed? Give the camera's calibration with "
                     "--camera-info if only noise is to blame");
  }
  return fit.camera(cloud.width, cloud.height);
}

void set_depth(const OrganizedCloud& cloud, DepthFrame& frame) {
  frame.metres_per_unit = depth_unit(cloud);
  frame.depth.resize(cloud.xyz.size() / 3);
  for (std::size_t i = 0; i < frame.depth.size(); ++i) {
    const float z = cloud.xyz[3 * i + 2];
    const double units = is_measured(z) ? std::round(double{z} / double{frame.metres_per_unit}) : 0;
    frame.depth[i] = units <= kMaximumDepth ? static_cast<std::uint16_t>(units) : std::uint16_t{0};
  }
}

OrganizedCloud cloud_of(const DepthFrame& frame) {
  OrganizedCloud cloud{frame.camera.width, frame.camera.height, {}};
  cloud.xyz.reserve(frame.depth.size() * 3);
  for (int v = 0; v < cloud.height; ++v) {
    for (int u = 0; u < cloud.width; ++u) {
      const float z = frame.metres(u, v);
      const Eigen::Vector3d point =
          z > 0.0F ? frame.camera.back_project(u, v, double{z})
                   : Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
      for (const double coordinate : {point.x(), point.y(), point.z()}) {
        cloud.xyz.push_back(static_cast<float>(coordinate));
      }
    }
  }
  return cloud;
}

}  // namespace lockbox
