// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/kernels/back_projection.hpp"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace lockbox::kernels {
namespace {

constexpr std::size_t kStride = 20;  // of the image, from row to row
constexpr std::size_t kImageRows = 5;
constexpr std::uint32_t kFirstPixel = 47;

class BackProjectionTest : public ::testing::Test {
 protected:
  BackProjectionTest() : depth(kStride * kImageRows) {
    for (std::size_t i = 0; i < depth.size(); ++i) {
      depth[i] = i % 7 == 3 || i / kStride == 2 ? 0.0F : 1.0F + 0.01F * static_cast<float>(i);
    }
    for (std::size_t u = 0; u < kMostTileColumns; ++u) {
      ray_x[u] = -0.3F + 0.1F * static_cast<float>(u);
    }
    for (std::size_t v = 0; v < kImageRows; ++v) ray_y[v] = 0.2F - 0.05F * static_cast<float>(v);
  }

  /// Also looks whether anything beyond the tile's own slots is written.
  std::size_t project(std::size_t columns) {
    for (auto* axis : {&x, &y, &z}) axis->fill(-5.0F);
    pixel.fill(99999);
    const std::size_t count = back_project(
        {depth.data(), ray_x.data(), ray_y.data(), kFirstPixel, kStride, columns, kImageRows},
        {x.data(), y.data(), z.data(), pixel.data()}, bounds);
    for (std::size_t i = columns * kImageRows; i < x.size(); ++i) {
      EXPECT_EQ(x[i], -5.0F);
      EXPECT_EQ(y[i], -5.0F);
      EXPECT_EQ(z[i], -5.0F);
      EXPECT_EQ(pixel[i], 99999U);
    }
    return count;
  }

  void expect_points(std::size_t columns, std::size_t count) const {
    std::size_t next = 0;
    float largest_x = -std::numeric_limits<float>::max();
    for (std::size_t v = 0; v < kImageRows; ++v) {
      for (std::size_t u = 0; u < columns; ++u) {
        const float metres = depth[v * kStride + u];
        if (metres == 0.0F) continue;
        ASSERT_LT(next, count);
        EXPECT_EQ(x[next], ray_x[u] * metres);
        EXPECT_EQ(y[next], ray_y[v] * metres);
        EXPECT_EQ(z[next], metres);
        EXPECT_EQ(pixel[next], kFirstPixel + v * kStride + u);
        largest_x = std::max(largest_x, x[next]);
        ++next;
      }
    }
    EXPECT_EQ(next, count);
    EXPECT_EQ(bounds.max[0], largest_x);
    const auto end = static_cast<std::ptrdiff_t>(count);
    EXPECT_EQ(bounds.min[2], *std::min_element(z.begin(), z.begin() + end));
  }

  std::vector<float> depth;
  std::array<float, kMostTileColumns> ray_x{};
  std::array<float, kImageRows> ray_y{};
  std::array<float, kMostTileColumns * kImageRows + 32> x{}, y{}, z{};
  std::array<std::uint32_t, kMostTileColumns * kImageRows + 32> pixel{};
  PointBounds bounds{};
};

TEST_F(BackProjectionTest, GivesTheKnownPixelsInOrderWithEveryInstructionSet) {
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    SCOPED_TRACE(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    for (const std::size_t columns : {1U, 3U, 6U, 13U, 16U}) {
      SCOPED_TRACE(columns);
      expect_points(columns, project(columns));
    }
  }
  hwy::SetSupportedTargetsForTest(0);
}

TEST_F(BackProjectionTest, FillsATileWhereAllIsKnown) {
  std::fill(depth.begin(), depth.end(), 1.5F);
  EXPECT_EQ(project(kMostTileColumns), kMostTileColumns * kImageRows);
  expect_points(kMostTileColumns, kMostTileColumns * kImageRows);
}

TEST_F(BackProjectionTest, OfNothingHasEmptyBounds) {
  std::fill(depth.begin(), depth.end(), 0.0F);
  EXPECT_EQ(project(10), 0U);
  EXPECT_GT(bounds.min[0], bounds.max[0]);
}

}  // namespace
}  // namespace lockbox::kernels
