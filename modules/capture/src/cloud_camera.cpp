// SPDX-License-Identifier: BSD-3-Clause
#include "cloud_camera.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lockbox/core/error.hpp"

namespace lockbox {
namespace {

constexpr std::size_t kMinimumPoints = 100;
constexpr double kMaximumResidual = 0.5;   // pixels, root mean square
constexpr double kMinimumSpread = 1e-3;    // of x / z, standard deviation
constexpr double kMaximumDepth = 65535.0;  // units

/// The line pixel = focal * slope + centre through many pairs.
class LineFit {
 public:
  void add(double slope, double pixel) {
    ++count_;
    sum_s_ += slope;
    sum_p_ += pixel;
    sum_ss_ += slope * slope;
    sum_sp_ += slope * pixel;
    sum_pp_ += pixel * pixel;
  }

  std::size_t count() const { return count_; }
  double spread() const { return std::sqrt(std::max(0.0, variance(sum_s_, sum_ss_))); }
  double focal() const { return covariance() / variance(sum_s_, sum_ss_); }
  double centre() const { return (sum_p_ - focal() * sum_s_) / n(); }
  double residual() const {
    return std::sqrt(std::max(0.0, variance(sum_p_, sum_pp_) - focal() * covariance()));
  }

 private:
  double n() const { return static_cast<double>(count_); }
  double variance(double sum, double squares) const {
    return squares / n() - (sum / n()) * (sum / n());
  }
  double covariance() const { return sum_sp_ / n() - (sum_s_ / n()) * (sum_p_ / n()); }

  std::size_t count_ = 0;
  double sum_s_ = 0.0, sum_p_ = 0.0, sum_ss_ = 0.0, sum_sp_ = 0.0, sum_pp_ = 0.0;
};

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

PinholeCamera recover_camera(const OrganizedCloud& cloud, const std::string& where) {
  LineFit horizontal;
  LineFit vertical;
  for (int v = 0; v < cloud.height; ++v) {
    for (int u = 0; u < cloud.width; ++u) {
      const float* const point =
          &cloud.xyz[3 * (static_cast<std::size_t>(v) * static_cast<std::size_t>(cloud.width) +
                          static_cast<std::size_t>(u))];
      if (is_measured(point[2]) && std::isfinite(point[0]) && std::isfinite(point[1])) {
        horizontal.add(double{point[0]} / double{point[2]}, u);
        vertical.add(double{point[1]} / double{point[2]}, v);
      }
    }
  }
  if (horizontal.count() < kMinimumPoints || horizontal.spread() < kMinimumSpread ||
      vertical.spread() < kMinimumSpread) {
    throw InputError(where,
                     "has too few points to recover the camera from; give its calibration with "
                     "--camera-info");
  }
  if (!(horizontal.residual() <= kMaximumResidual) || !(vertical.residual() <= kMaximumResidual) ||
      !(horizontal.focal() > 0.0) || !(vertical.focal() > 0.0)) {
    throw InputError(where,
                     "its points do not lie on the rays of a pinhole camera (z forward, x right, y "
                     "down); was the cloud transformed? Give the camera's calibration with "
                     "--camera-info if only noise is to blame");
  }
  return {cloud.width,      cloud.height,        horizontal.focal(),
          vertical.focal(), horizontal.centre(), vertical.centre()};
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
