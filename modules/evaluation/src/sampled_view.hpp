// SPDX-License-Identifier: BSD-3-Clause
// The scene rendered finer than the image, with the neighbourhoods that a pixel may look at.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lockbox/core/parallel.hpp"
#include "lockbox/core/pinhole_camera.hpp"
#include "lockbox/rendering/depth_renderer.hpp"
#include "lockbox/simulation/sensor_model.hpp"

namespace lockbox {

class SampledView {
 public:
  static constexpr int kRefinement = 3;  ///< samples a pixel and axis

  SampledView(const PinholeCamera& camera, const SensorModel& sensor, const Executor& executor);

  void render(std::span<const RenderItem> items);

  const PinholeCamera& sample_camera() const { return renderer_.camera(); }
  int width() const { return image_.width; }
  int height() const { return image_.height; }

  /// Depth times disparity, metres times pixels.
  float unit_disparity_depth() const { return unit_disparity_depth_; }
  /// Pixels of the image; 0 where the sensor sees nothing, or out of its range.
  float disparity(int u, int v) const { return disparity_[image_.index(u, v)]; }
  std::int16_t id(int u, int v) const { return image_.id[image_.index(u, v)]; }

  /// How far from a pixel's centre it looks, samples.
  int reach() const { return reach_; }
  /// Whether pixel (u, v) of the image looks at one smooth surface of one item.
  bool is_smooth(int u, int v) const;

 private:
  bool breaks_at(int u, int v) const;
  void find_breaks(int v);

  PinholeCamera camera_;
  Executor executor_;
  DepthRenderer renderer_;
  float unit_disparity_depth_;
  float nearest_;
  float farthest_;
  int reach_;
  RenderedDepth image_;
  std::vector<float> disparity_;
  /// By row of samples and column of the image: whether the surface breaks within reach.
  std::vector<std::uint8_t> breaks_in_row_;
};

}  // namespace lockbox
