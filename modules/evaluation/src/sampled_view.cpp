// SPDX-License-Identifier: BSD-3-Clause
#include "sampled_view.hpp"

#include <cmath>

#include "jitter.hpp"

namespace lockbox {
namespace {

constexpr std::size_t kRowsAtOnce = 32;

/// Disparity of a plane is linear in the image; a second difference above this (pixels) is a crease
/// or an edge. Rounding stays below by a factor of 100, walls of a millimetre above by 10.
constexpr float kSmooth = 1e-3F;

}  // namespace

SampledView::SampledView(const PinholeCamera& camera, const SensorModel& sensor,
                         const Executor& executor)
    : camera_(camera),
      executor_(executor),
      renderer_(refined(camera, kRefinement), executor),
      unit_disparity_depth_(static_cast<float>(camera.fx * sensor.baseline)),
      nearest_(static_cast<float>(sensor.min_range)),
      farthest_(static_cast<float>(sensor.max_range)),
      reach_(static_cast<int>(std::ceil(kJitterReach * effective_jitter(sensor) * kRefinement))) {}

void SampledView::render(std::span<const RenderItem> items) {
  renderer_.render(items, image_);
  disparity_.resize(image_.depth.size());
  executor_.for_each_chunk(
      image_.depth.size(), 1U << 16U, [this](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
          const float z = image_.depth[i];
          disparity_[i] = z >= nearest_ && z <= farthest_ ? unit_disparity_depth_ / z : 0.0F;
        }
      });
  const auto rows = static_cast<std::size_t>(image_.height);
  breaks_in_row_.assign(rows * static_cast<std::size_t>(camera_.width), 0);
  executor_.for_each_chunk(rows, kRowsAtOnce,
                           [this](std::size_t begin, std::size_t end, std::size_t) {
                             for (std::size_t v = begin; v < end; ++v) {
                               find_breaks(static_cast<int>(v));
                             }
                           });
}

bool SampledView::breaks_at(int u, int v) const {
  if (u == 0 || v == 0 || u == width() - 1 || v == height() - 1) return true;
  const std::int16_t here = id(u, v);
  const float d = disparity(u, v);
  return id(u + 1, v) != here || id(u, v + 1) != here ||
         std::abs(disparity(u - 1, v) + disparity(u + 1, v) - 2.0F * d) > kSmooth ||
         std::abs(disparity(u, v - 1) + disparity(u, v + 1) - 2.0F * d) > kSmooth;
}

void SampledView::find_breaks(int v) {
  std::uint8_t* const row =
      &breaks_in_row_[static_cast<std::size_t>(v) * static_cast<std::size_t>(camera_.width)];
  for (int u = 0; u < width(); ++u) {
    if (!breaks_at(u, v)) continue;
    // The pixels whose reach ends at or beyond this sample.
    const int first = std::max(0, (u - reach_ + kRefinement - 1) / kRefinement);
    const int last = std::min(camera_.width - 1, (u + reach_) / kRefinement);
    for (int pixel = first; pixel <= last; ++pixel) row[pixel] = 1;
  }
}

bool SampledView::is_smooth(int u, int v) const {
  const int first = v * kRefinement - reach_;
  const int last = v * kRefinement + reach_;
  if (first < 0 || last >= height()) return false;
  for (int row = first; row <= last; ++row) {
    const auto i = static_cast<std::size_t>(row) * static_cast<std::size_t>(camera_.width) +
                   static_cast<std::size_t>(u);
    if (breaks_in_row_[i] != 0) return false;
  }
  return true;
}

}  // namespace lockbox
