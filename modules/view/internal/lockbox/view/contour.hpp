// SPDX-License-Identifier: BSD-3-Clause
// The model's surface around one pixel of a z-buffer, and the contour that may pass there.
#pragma once

#include <Eigen/Core>
#include <algorithm>

#include "lockbox/rendering/depth_renderer.hpp"

namespace lockbox {

/// The tangent plane at a pixel that shows a body. In an image of a plane 1 / depth is linear.
class TangentPlane {
 public:
  TangentPlane(const RenderedDepth& image, int u, int v);

  /// Depth of the plane at (du, dv) pixels from here, as a multiple of the depth here.
  double relative_depth(int du, int dv) const { return 1.0 / relative_nearness(du, dv); }
  /// And 1 / depth of the plane there, as a multiple of that here.
  double relative_nearness(int du, int dv) const {
    return std::max(kHorizon, 1.0 + slope_u_ * du + slope_v_ * dv);
  }

  /// Returns the slopes of 1 / depth, relative to the value here, per pixel along u and v.
  Eigen::Vector2d slopes() const { return {slope_u_, slope_v_}; }

  /// Largest change of the depth from one pixel to the next, as a share of the depth.
  double steepness() const { return slopes().norm(); }

 private:
  /// 1 / depth of a plane, of that here, at least, as nothing is seen beyond its horizon. Source:
  /// not recorded. Doubled, steep planes end at five times the depth, not at ten.
  static constexpr double kHorizon = 0.1;

  double slope_u_;
  double slope_v_;
};

/// The outward normal, a unit vector in the image, of the contour that passes near pixel (u, v);
/// zero where none does. A contour is where a body's surface ends and whatever the image shows
/// beside it lies farther away, by at least the share `step` of the depth.
Eigen::Vector2d contour_normal(const RenderedDepth& image, const TangentPlane& plane, int u, int v,
                               double step);

}  // namespace lockbox
