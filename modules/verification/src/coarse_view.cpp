// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/verification/coarse_view.hpp"

#include <algorithm>
#include <cmath>

#include "lockbox/rendering/depth_renderer.hpp"

namespace lockbox {
namespace {

float median_of_block(const TiledCloud& cloud, int u0, int v0, int factor,
                      std::vector<float>& values) {
  values.clear();
  for (int v = v0; v < v0 + factor; ++v) {
    for (int u = u0; u < u0 + factor; ++u) {
      const float z = cloud.depth()[static_cast<std::size_t>(v) *
                                        static_cast<std::size_t>(cloud.camera().width) +
                                    static_cast<std::size_t>(u)];
      if (z > 0.0F) values.push_back(z);
    }
  }
  if (2 * values.size() < static_cast<std::size_t>(factor) * static_cast<std::size_t>(factor)) {
    return 0.0F;
  }
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::vector<float> nearest_around(const CoarseView& view) {
  std::vector<float> nearest(view.depth);
  for (int v = 0; v < view.camera.height; ++v) {
    for (int u = 0; u < view.camera.width; ++u) {
      float& least = nearest[view.index(u, v)];
      for (int dv = -1; dv <= 1; ++dv) {
        for (int du = -1; du <= 1; ++du) {
          if (!view.contains(u + du, v + dv)) continue;
          const float z = view.depth[view.index(u + du, v + dv)];
          if (z > 0.0F && !(least > 0.0F && least <= z)) least = z;
        }
      }
    }
  }
  return nearest;
}

}  // namespace

CoarseView::CoarseView(const TiledCloud& cloud, int columns, const Executor& executor,
                       double shift) {
  PinholeCamera full = cloud.camera();
  const int factor = std::clamp((full.width + columns / 2) / columns, 1,
                                std::max(1, std::min(full.width, full.height)));
  const int begin = static_cast<int>(shift * factor);
  full.width -= begin;
  full.height -= begin;
  full.cx -= begin;
  full.cy -= begin;
  camera = reduced(full, factor);
  depth.resize(static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height));
  executor.for_each(static_cast<std::size_t>(camera.height), [&](std::size_t row) {
    const int v = static_cast<int>(row);
    std::vector<float> values;
    for (int u = 0; u < camera.width; ++u) {
      depth[index(u, v)] =
          median_of_block(cloud, begin + u * factor, begin + v * factor, factor, values);
    }
  });
  nearest = nearest_around(*this);
}

}  // namespace lockbox
