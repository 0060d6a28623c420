// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/visualization/depth_picture.hpp"

#include <algorithm>

namespace lockbox {
namespace {

/// The depths between which nearly all measurements lie: the few outside would cost all contrast.
struct Range {
  float near;
  float far;
};

Range contrast_range(const DepthFrame& frame) {
  std::vector<std::uint16_t> measured;
  for (const auto depth : frame.depth) {
    if (depth != 0) measured.push_back(depth);
  }
  if (measured.empty()) return {0.0F, 1.0F};
  std::sort(measured.begin(), measured.end());
  const std::size_t rare = measured.size() / 100;
  return {static_cast<float>(measured[rare]),
          static_cast<float>(measured[measured.size() - 1 - rare]) + 1.0F};
}

}  // namespace

RgbImage depth_picture(const DepthFrame& frame) {
  constexpr float kBrightest = 235.0F;
  constexpr float kDarkest = 50.0F;
  RgbImage image(frame.camera.width, frame.camera.height, 0);
  const Range range = contrast_range(frame);
  for (std::size_t i = 0; i < frame.depth.size(); ++i) {
    if (frame.depth[i] == 0) continue;
    const float distance =
        (static_cast<float>(frame.depth[i]) - range.near) / (range.far - range.near);
    const float grey = kBrightest + (kDarkest - kBrightest) * std::clamp(distance, 0.0F, 1.0F);
    std::fill_n(image.rgb.begin() + static_cast<std::ptrdiff_t>(3 * i), 3,
                static_cast<std::uint8_t>(grey));
  }
  return image;
}

}  // namespace lockbox
