// SPDX-License-Identifier: BSD-3-Clause
// The pinhole camera that an organized cloud was seen with, recovered from its points.
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "lockbox/core/pinhole_camera.hpp"

namespace lockbox {

/// Least squares over points and the pixels that saw them: u = fx x / z + cx, and so for v.
class PinholeFit {
 public:
  /// p_camera: metres. Points that are not finite, or not in front of the camera, are left out.
  void add(double u, double v, const Eigen::Vector3d& p_camera) {
    if (p_camera.allFinite() && p_camera.z() > 0.0) {
      horizontal_.add(p_camera.x() / p_camera.z(), u);
      vertical_.add(p_camera.y() / p_camera.z(), v);
    }
  }

  /// Whether there are enough points, in enough directions.
  bool is_determined() const;

  /// Whether the points lie on the rays of the camera, within half a pixel root mean square.
  bool is_pinhole() const;

  /// Root mean square distance from the rays in pixels, of rows or columns, whichever is larger.
  double residual() const;

  PinholeCamera camera(int width, int height) const;

 private:
  /// The line pixel = focal * slope + centre through many pairs.
  class Line {
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
    double spread() const;  ///< standard deviation of the slopes
    double focal() const;
    double centre() const;
    double residual() const;  ///< root mean square, pixels

   private:
    double mean(double sum) const { return sum / static_cast<double>(count_); }
    double slope_variance() const;
    double covariance() const;

    std::size_t count_ = 0;
    double sum_s_ = 0.0, sum_p_ = 0.0, sum_ss_ = 0.0, sum_sp_ = 0.0, sum_pp_ = 0.0;
  };

  Line horizontal_;
  Line vertical_;
};

}  // namespace lockbox
