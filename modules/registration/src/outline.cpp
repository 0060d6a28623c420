// SPDX-License-Identifier: BSD-3-Clause
#include "outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace lockbox {
namespace {

constexpr int kReach = 3;  // pixels around the sample in which an outline counts as near
constexpr double kLeastOutline = 0.5;  // of the normal's length: an outline, not a stray pixel

/// How much a neighbour at (du, dv) within reach that lies beyond an outline says of its normal:
/// its direction, less the farther it is.
class PullTable {
 public:
  PullTable() {
    for (int dv = -kReach; dv <= kReach; ++dv) {
      for (int du = -kReach; du <= kReach; ++du) {
        const int distance2 = du * du + dv * dv;
        const bool counts = distance2 > 0 && distance2 <= kReach * kReach;
        entries_[index(du, dv)] =
            counts ? Eigen::Vector2d(du, dv) / distance2 : Eigen::Vector2d(0.0, 0.0);
      }
    }
  }
  const Eigen::Vector2d& at(int du, int dv) const { return entries_[index(du, dv)]; }

 private:
  static std::size_t index(int du, int dv) {
    return static_cast<std::size_t>((dv + kReach) * (2 * kReach + 1) + du + kReach);
  }
  std::array<Eigen::Vector2d, (2 * kReach + 1) * (2 * kReach + 1)> entries_;
};

const PullTable kPull;

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
  const int first_u = std::max(-kReach, -u);
  const int last_u = std::min(kReach, image.width - 1 - u);
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();
  for (int dv = std::max(-kReach, -v); dv <= std::min(kReach, image.height - 1 - v); ++dv) {
    const float* row = image.depth.data() + image.index(u, v + dv);
    for (int du = first_u; du <= last_u; ++du) {
      // there > depth (1 / nearness + step), without a division
      const double nearness = plane.relative_nearness(du, dv);
      const bool is_beyond =
          static_cast<double>(row[du]) * nearness > depth * (1.0 + step * nearness);
      normal += is_beyond ? kPull.at(du, dv) : Eigen::Vector2d::Zero();
    }
  }
  const double length = normal.norm();
  return length > kLeastOutline ? Eigen::Vector2d(normal / length) : Eigen::Vector2d::Zero();
}

}  // namespace lockbox
