// SPDX-License-Identifier: BSD-3-Clause
#include "surface.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace lockbox::simulation {
namespace {

/// Of two one-sided differences: at an edge, the smaller one stays on the surface.
float gentler(float a, float b) {
  return std::abs(a) < std::abs(b) ? a : b;
}

}  // namespace

float depth_at(const RenderedDepth& image, int u, int v) {
  const int column = std::clamp(u, 0, image.width - 1);
  const int row = std::clamp(v, 0, image.height - 1);
  return image.depth[static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) +
                     static_cast<std::size_t>(column)];
}

// A plane n.p = 1 has the inverse depth w = n.r on the ray r = (x, y, 1): n = (fx w_u, fy w_v,
// w - x fx w_u - y fy w_v). Scaled by z^2, with w_u = -z_u / z^2.
float cosine_of_incidence(const RenderedDepth& image, const PinholeCamera& camera, int u, int v) {
  const float z = depth_at(image, u, v);
  const float z_u = u == 0 ? depth_at(image, u + 1, v) - z
                    : u == image.width - 1
                        ? z - depth_at(image, u - 1, v)
                        : gentler(z - depth_at(image, u - 1, v), depth_at(image, u + 1, v) - z);
  const float z_v = v == 0 ? depth_at(image, u, v + 1) - z
                    : v == image.height - 1
                        ? z - depth_at(image, u, v - 1)
                        : gentler(z - depth_at(image, u, v - 1), depth_at(image, u, v + 1) - z);
  const float x = static_cast<float>((u - camera.cx) / camera.fx);
  const float y = static_cast<float>((v - camera.cy) / camera.fy);
  const float n_x = -static_cast<float>(camera.fx) * z_u;
  const float n_y = -static_cast<float>(camera.fy) * z_v;
  const float n_z = z - x * n_x - y * n_y;
  return z / std::sqrt((n_x * n_x + n_y * n_y + n_z * n_z) * (x * x + y * y + 1.0F));
}

bool beside_jump(const RenderedDepth& image, int u, int v, int distance,
                 float unit_disparity_depth) {
  const float here = depth_at(image, u, v);
  const auto [nearest, farthest] =
      std::minmax({here, depth_at(image, u - distance, v), depth_at(image, u + distance, v),
                   depth_at(image, u, v - distance), depth_at(image, u, v + distance)});
  // unit / near - unit / far > 1, for a far depth that may be infinite.
  const auto jump = [unit_disparity_depth](float near, float far) {
    return std::isfinite(near) && unit_disparity_depth - near > near * (unit_disparity_depth / far);
  };
  return jump(nearest, here) || jump(here, farthest);
}

}  // namespace lockbox::simulation
