// SPDX-License-Identifier: BSD-3-Clause
// What the neighbourhood of a sample tells about the surface there. Asked for every pixel: inline.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "lockbox/core/pinhole_camera.hpp"
#include "lockbox/rendering/depth_renderer.hpp"

namespace lockbox::simulation {

/// A view of a clean depth image and of the camera that it was drawn with.
class Surface {
 public:
  Surface(const RenderedDepth& image, const PinholeCamera& camera)
      : depth_(image.depth.data()),
        width_(image.width),
        height_(image.height),
        fx_(static_cast<float>(camera.fx)),
        fy_(static_cast<float>(camera.fy)),
        inverse_fx_(1.0F / fx_),
        inverse_fy_(1.0F / fy_),
        cx_(static_cast<float>(camera.cx)),
        cy_(static_cast<float>(camera.cy)) {}

  /// Returns the depth of the sample, or of the nearest one in the image; metres.
  float depth(int u, int v) const {
    const int column = std::clamp(u, 0, width_ - 1);
    const int row = std::clamp(v, 0, height_ - 1);
    return depth_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                  static_cast<std::size_t>(column)];
  }

  /// Square of the cosine of the angle between the ray of sample (u, v), whose depth is finite, and
  /// the surface's normal. At an edge the surface goes on as it does on the side away from it.
  //
  // A plane n.p = 1 has the inverse depth w = n.r on the ray r = (x, y, 1): n = (fx w_u, fy w_v,
  // w - x fx w_u - y fy w_v). Here scaled by z^2, with w_u = -z_u / z^2.
  float squared_cosine(int u, int v) const {
    const float z = depth(u, v);
    const float z_u = slope(depth(u - 1, v), z, depth(u + 1, v), u == 0, u == width_ - 1);
    const float z_v = slope(depth(u, v - 1), z, depth(u, v + 1), v == 0, v == height_ - 1);
    const float x = (static_cast<float>(u) - cx_) * inverse_fx_;
    const float y = (static_cast<float>(v) - cy_) * inverse_fy_;
    const float n_x = -fx_ * z_u;
    const float n_y = -fy_ * z_v;
    const float n_z = z - x * n_x - y * n_y;
    return z * z / ((n_x * n_x + n_y * n_y + n_z * n_z) * (x * x + y * y + 1.0F));
  }

  /// Whether the disparity of the sample differs by more than 1 from that of one of its four
  /// neighbours, `distance` samples away. unit_disparity_depth: where the disparity is 1, metres.
  bool beside_jump(int u, int v, int distance, float unit_disparity_depth) const {
    const float here = depth(u, v);
    const float left = depth(u - distance, v);
    const float right = depth(u + distance, v);
    const float above = depth(u, v - distance);
    const float below = depth(u, v + distance);
    const float nearest = std::min(std::min(left, right), std::min(above, below));
    const float farthest = std::max(std::max(left, right), std::max(above, below));
    // unit / near - unit / far > 1, for depths that may be infinite.
    const auto jump = [unit_disparity_depth](float near, float far) {
      return far * (unit_disparity_depth - near) > unit_disparity_depth * near;
    };
    return jump(nearest, here) || jump(here, farthest);
  }

 private:
  /// Returns the smaller one of two one-sided differences: at an edge it stays on the surface.
  static float slope(float before, float here, float after, bool at_begin, bool at_end) {
    const float backward = here - before;
    const float forward = after - here;
    const bool take_forward = at_begin || (!at_end && std::abs(forward) < std::abs(backward));
    return take_forward ? forward : backward;
  }

  const float* depth_;
  int width_;
  int height_;
  float fx_;
  float fy_;
  float inverse_fx_;
  float inverse_fy_;
  float cx_;
  float cy_;
};

}  // namespace lockbox::simulation
