// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/view/contour.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "lockbox/kernels/contours.hpp"

namespace lockbox {
namespace {

constexpr double kLeastContour = 0.5;  // of the normal's length: a contour, not a stray pixel

bool inside(const RenderedDepth& image, int u, int v) {
  return u >= 0 && v >= 0 && u < image.width && v < image.height;
}

/// Relative change of 1 / depth from pixel (u, v) along (du, dv): of both ways the one that changes
/// less, for the other may lead over an edge.
double slope(const RenderedDepth& image, int u, int v, int du, int dv) {
  constexpr float kUnknown = std::numeric_limits<float>::infinity();
  const std::size_t here = image.index(u, v);
  const auto change = [&](int way) {
    if (!inside(image, u + way * du, v + way * dv)) return kUnknown;
    const std::size_t there = image.index(u + way * du, v + way * dv);
    const float nearer = image.depth[here] / image.depth[there] - 1.0F;
    return image.id[there] == image.id[here] ? nearer : kUnknown;
  };
  const float before = -change(-1);
  const float after = change(1);
  const float least = std::abs(after) < std::abs(before) ? after : before;
  return std::abs(least) < kUnknown ? static_cast<double>(least) : 0.0;
}

}  // namespace

TangentPlane::TangentPlane(const RenderedDepth& image, int u, int v)
    : slope_u_(slope(image, u, v, 1, 0)), slope_v_(slope(image, u, v, 0, 1)) {}

namespace {

using kernels::kVoteColumns;
using kernels::kVoteReach;
using kernels::kVoteRows;

/// The depths around a pixel near the border of the image: 0, which lies beyond nothing, outside.
std::array<float, std::size_t{kVoteRows} * kVoteColumns> with_border(const RenderedDepth& image,
                                                                     int u, int v) {
  std::array<float, std::size_t{kVoteRows} * kVoteColumns> depths{};
  for (int row = 0; row < kVoteRows; ++row) {
    for (int column = 0; column < kVoteRows; ++column) {
      const int at_u = u + column - kVoteReach;
      const int at_v = v + row - kVoteReach;
      if (!inside(image, at_u, at_v)) continue;
      depths[static_cast<std::size_t>(row * kVoteColumns + column)] =
          image.depth[image.index(at_u, at_v)];
    }
  }
  return depths;
}

}  // namespace

Eigen::Vector2d contour_normal(const RenderedDepth& image, const TangentPlane& plane, int u, int v,
                               double step) {
  const Eigen::Vector2d slopes = plane.slopes();
  const kernels::PixelPlane pixel{image.depth[image.index(u, v)], static_cast<float>(slopes.x()),
                                  static_cast<float>(slopes.y())};
  const bool is_within = inside(image, u - kVoteReach, v - kVoteReach) &&
                         inside(image, u - kVoteReach + kVoteColumns, v + kVoteReach);
  kernels::NormalVote vote;
  if (is_within) {
    vote = kernels::normal_vote(&image.depth[image.index(u - kVoteReach, v - kVoteReach)],
                                image.width, pixel, static_cast<float>(step));
  } else {
    const auto depths = with_border(image, u, v);
    vote = kernels::normal_vote(depths.data(), kVoteColumns, pixel, static_cast<float>(step));
  }
  const Eigen::Vector2d normal = Eigen::Vector2d(vote.u, vote.v) / kernels::NormalVote::kUnit;
  const double length = normal.norm();
  return length > kLeastContour ? Eigen::Vector2d(normal / length) : Eigen::Vector2d::Zero();
}

}  // namespace lockbox
