// SPDX-License-Identifier: BSD-3-Clause
#include "contour_continuation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace lockbox {
namespace {

constexpr float kNear = 1.0F;  // metres: where the board is drawn, and measured
constexpr float kFar = 3.0F;
constexpr int kMargin = 2;  // pixels around the board

bool is_on_board(int u, int v, int width, int height) {
  return u >= kMargin && v >= kMargin && u < width - kMargin && v < height - kMargin;
}

/// An image of which the camera measured these depths, the board's and that around it.
CoarseView measured_view(int width, int height, float board, float around) {
  const double focal = 0.9 * width;
  std::vector<float> depth;
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const bool is_inside = is_on_board(u, v, width, height);
      depth.push_back(is_inside ? board : around);
    }
  }
  CloudOptions unfiltered;
  unfiltered.flying_pixel_jump = 0.0;
  TiledCloud cloud;
  cloud.assign({width, height, focal, focal, 0.5 * (width - 1), 0.5 * (height - 1)}, depth,
               unfiltered, Executor(1));
  return {cloud, width, Executor(1)};
}

/// A board that is drawn up to the margin.
RenderedDepth drawn_board(int width, int height) {
  RenderedDepth image;
  image.width = width;
  image.height = height;
  image.drawn = {0, 0, width, height};
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const bool is_inside = is_on_board(u, v, width, height);
      image.depth.push_back(is_inside ? kNear : std::numeric_limits<float>::infinity());
      image.id.push_back(is_inside ? 0 : kNothing);
    }
  }
  return image;
}

double share(int width, int height, float around) {
  constexpr double kNoise = 1e-3;  // 1/metre
  return share_that_continues(drawn_board(width, height),
                              measured_view(width, height, kNear, around), kNoise, 0.0);
}

TEST(ContourContinuation, TellsABoardFromAPatchOfAWall) {
  EXPECT_GT(share(64, 48, kNear), 0.9);
  EXPECT_LT(share(64, 48, kFar), 0.1);
}

/// Sides that are no multiples of what contours are divided into.
TEST(ContourContinuation, ImagesMayHaveAnySize) {
  for (int width = 1; width <= 34; ++width) {
    for (int height = 1; height <= 34; ++height) {
      const int across = width - 2 * kMargin;  // of the board
      const int down = height - 2 * kMargin;
      // A contour only counts where the board is seen beside it, too.
      const bool has_contour = std::min(across, down) > 0 && std::max(across, down) > 1;
      const double at_wall = share(width, height, kNear);
      const double alone = share(width, height, kFar);
      if (has_contour) {
        EXPECT_GT(at_wall, alone) << width << " x " << height;
      } else {
        EXPECT_EQ(at_wall, 0.0) << width << " x " << height;
      }
    }
  }
}

}  // namespace
}  // namespace lockbox
