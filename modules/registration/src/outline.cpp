// SPDX-License-Identifier: BSD-3-Clause
#include "outline.hpp"

#include <algorithm>
#include <cmath>

namespace lockbox {
namespace {

constexpr int kReach = 3;  // pixels around the sample in which an outline counts as near
constexpr double kLeastOutline = 0.5;  // of the normal's length: an outline, not a stray pixel

bool inside(const RenderedDepth& image, int u, int v) {
  return u >= 0 && v >= 0 && u < image.width && v < image.height;
}

/// Relative change of 1 / depth from pixel (u, v) along (du, dv): of both ways the one that changes
/// less, for the other may lead over an edge.
double slope(const RenderedDepth& image, int u, int v, int du, int dv) {
  const std::size_t here = image.index(u, v);
  double best = 0.0;
  bool known = false;
  for (const int way : {-1, 1}) {
    if (!inside(image, u + way * du, v + way * dv)) {
      continue;
    }
    const std::size_t there = image.index(u + way * du, v + way * dv);
    if (image.id[there] != image.id[here]) {
      continue;
    }
    const double change =
        way *
        (static_cast<double>(image.depth[here]) / static_cast<double>(image.depth[there]) - 1.0);
    if (!known || std::abs(change) < std::abs(best)) {
      best = change;
      known = true;
    }
  }
  return best;
}

}  // namespace

TangentPlane::TangentPlane(const RenderedDepth& image, int u, int v)
    : slope_u_(slope(image, u, v, 1, 0)), slope_v_(slope(image, u, v, 0, 1)) {}

Eigen::Vector2d outline_normal(const RenderedDepth& image, const TangentPlane& plane, int u, int v,
                               double step) {
  const auto depth = static_cast<double>(image.depth[image.index(u, v)]);
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();
  for (int dv = -kReach; dv <= kReach; ++dv) {
    for (int du = -kReach; du <= kReach; ++du) {
      const int distance2 = du * du + dv * dv;
      if (distance2 == 0 || distance2 > kReach * kReach || !inside(image, u + du, v + dv)) {
        continue;
      }
      const auto there = static_cast<double>(image.depth[image.index(u + du, v + dv)]);
      if (there > depth * (plane.relative_depth(du, dv) + step)) {
        normal += Eigen::Vector2d(du, dv) / distance2;
      }
    }
  }
  const double length = normal.norm();
  return length > kLeastOutline ? Eigen::Vector2d(normal / length) : Eigen::Vector2d::Zero();
}

}  // namespace lockbox
