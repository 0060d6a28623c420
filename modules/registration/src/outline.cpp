// SPDX-License-Identifier: BSD-3-Clause
#include "outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace lockbox {
namespace {

constexpr int kReach = 3;  // pixels around the sample in which an outline counts as near
constexpr double kLeastOutline = 0.5;  // of the normal's length: an outline, not a stray pixel

constexpr int kAround = 2 * kReach + 1;
constexpr int kPullUnit = 360;  // that all squared distances within reach divide

/// How much a neighbour at (du, dv) within reach that lies beyond an outline says of its normal:
/// its direction, less the farther it is. In whole units, whose sums are exact in any order: so
/// they are made for several neighbours at once.
struct PullTable {
  using Rows = std::array<std::array<int, kAround>, kAround>;
  Rows u{};
  Rows v{};

  constexpr PullTable() {
    for (int dv = -kReach; dv <= kReach; ++dv) {
      for (int du = -kReach; du <= kReach; ++du) {
        const int distance2 = du * du + dv * dv;
        if (distance2 == 0 || distance2 > kReach * kReach) continue;
        const auto row = static_cast<std::size_t>(dv + kReach);
        const auto column = static_cast<std::size_t>(du + kReach);
        u[row][column] = kPullUnit * du / distance2;
        v[row][column] = kPullUnit * dv / distance2;
      }
    }
  }
};

constexpr PullTable kPull;

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
  int pull_u = 0;
  int pull_v = 0;
  for (int dv = std::max(-kReach, -v); dv <= std::min(kReach, image.height - 1 - v); ++dv) {
    const float* row = image.depth.data() + image.index(u, v + dv);
    const auto& pulls_u = kPull.u[static_cast<std::size_t>(dv + kReach)];
    const auto& pulls_v = kPull.v[static_cast<std::size_t>(dv + kReach)];
    for (int du = first_u; du <= last_u; ++du) {
      // there > depth (1 / nearness + step), without a division
      const double nearness = plane.relative_nearness(du, dv);
      const bool is_beyond =
          static_cast<double>(row[du]) * nearness > depth * (1.0 + step * nearness);
      pull_u += is_beyond ? pulls_u[static_cast<std::size_t>(du + kReach)] : 0;
      pull_v += is_beyond ? pulls_v[static_cast<std::size_t>(du + kReach)] : 0;
    }
  }
  const Eigen::Vector2d normal = Eigen::Vector2d(pull_u, pull_v) / kPullUnit;
  const double length = normal.norm();
  return length > kLeastOutline ? Eigen::Vector2d(normal / length) : Eigen::Vector2d::Zero();
}

}  // namespace lockbox
