// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/simulation/model_visibility.hpp"

#include <utility>

#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/rendering/body_item.hpp"

namespace lockbox {
namespace {

/// Twice the field on half as many pixels: shares do not need more.
PinholeCamera widened(const PinholeCamera& camera) {
  PinholeCamera wide = camera;
  wide.fx = 0.5 * camera.fx;
  wide.fy = 0.5 * camera.fy;
  wide.cx = 0.5 * (camera.cx + 0.5 * camera.width);
  wide.cy = 0.5 * (camera.cy + 0.5 * camera.height);
  return wide;
}

ImageWindow middle_of(const PinholeCamera& camera) {
  return {camera.width / 4, camera.height / 4, camera.width / 2, camera.height / 2};
}

std::size_t model_pixels(const RenderedDepth& image, const ImageWindow& window) {
  std::size_t count = 0;
  for (int v = window.top; v < window.bottom(); ++v) {
    for (int u = window.left; u < window.right(); ++u) {
      const auto id = image.id[image.index(u, v)];
      count += id != kNothing && id < kBackgroundId ? 1 : 0;
    }
  }
  return count;
}

double missing(std::size_t part, std::size_t whole) {
  return whole > 0 ? 1.0 - static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

}  // namespace

VisibilityMeter::VisibilityMeter(const KinematicTree& tree, const PinholeCamera& camera,
                                 PlacedScene scene, const Executor& executor)
    : tree_(tree),
      scene_(std::move(scene)),
      renderer_(widened(camera), executor),
      image_(middle_of(camera)) {}

ModelVisibility VisibilityMeter::measure(const State& state) {
  forward_kinematics(tree_, state.configuration, T_camera_body_);
  items_.clear();
  for (std::size_t b = 0; b < tree_.bodies.size(); ++b) {
    items_.push_back(body_item(tree_, b, T_camera_body_[b]));
  }
  renderer_.render(items_, drawn_);
  const std::size_t all = model_pixels(drawn_, {0, 0, drawn_.width, drawn_.height});
  const std::size_t in_image = model_pixels(drawn_, image_);
  if (all == 0) return {1.0, 0.0};
  scene_.append_items(state, items_);
  renderer_.render(items_, drawn_);
  return {missing(in_image, all), missing(model_pixels(drawn_, image_), in_image)};
}

}  // namespace lockbox
