// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/kernels/reprojection.hpp"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <array>
#include <cmath>
#include <vector>

namespace lockbox::kernels {
namespace {

/// Points along a row of a coarse grid; the depths of the measured image tell its pixels apart.
class ReprojectionTest : public ::testing::Test {
 protected:
  static constexpr std::size_t kPoints = 75;  // no multiple of any number of lanes
  static constexpr Intrinsics kCamera{120.0F, 122.0F, 74.5F, 40.5F, 150, 80};

  ReprojectionTest() : measured(150 * 80) {
    for (std::size_t i = 0; i < measured.size(); ++i) {
      measured[i] = 1.0F + 1e-4F * static_cast<float>(i);
    }
    for (auto* axis : {&x, &y, &z}) axis->fill(kPadding);
    lay_row(9);
  }

  /// At the pixels (2 u + 0.5, 2 row + 0.5) of the camera: corners of four pixels.
  void lay_row(int row) {
    for (std::size_t i = 0; i < kPoints; ++i) {
      z[i] = 0.9F + 0.003F * static_cast<float>(i);
      x[i] = (static_cast<float>(i) - 37.0F) / 60.0F * z[i];
      y[i] = (static_cast<float>(row) - 20.0F) / 61.0F * z[i];
    }
  }

  void land_points() {
    land({x.data(), y.data(), z.data(), x.size()}, motion, {measured.data(), kCamera},
         {expected.data(), seen_x.data(), seen_y.data(), seen.data(), pixel.data()});
  }

  template <typename T>
  using ByPoint = std::array<T, padded(kPoints)>;
  ByPoint<float> x, y, z;
  std::vector<float> measured;
  /// Turned by a hundredth, moved aside and nearer.
  RigidMotion motion{{1, -0.01F, 0, 0.01F, 1, 0, 0, 0, 1}, {0.1F, -0.001F, -0.05F}};
  ByPoint<float> expected;
  ByPoint<float> seen_x;
  ByPoint<float> seen_y;
  ByPoint<float> seen;
  ByPoint<std::int32_t> pixel;
};

TEST_F(ReprojectionTest, PointsLandInThePixelThatSeesThem) {
  land_points();
  int landed = 0;
  int outside = 0;
  int undecided = 0;
  for (std::size_t i = 0; i < kPoints; ++i) {
    const double p[3] = {static_cast<double>(x[i]), static_cast<double>(y[i]),
                         static_cast<double>(z[i])};
    double q[3];
    for (int row = 0; row < 3; ++row) {
      q[row] = static_cast<double>(motion.translation[row]);
      for (int column = 0; column < 3; ++column) {
        q[row] += static_cast<double>(motion.rotation[3 * row + column]) * p[column];
      }
    }
    EXPECT_NEAR(expected[i], q[2], 1e-6);
    if (pixel[i] == kUndecided) {
      ++undecided;
      continue;
    }
    const double at_u = 120.0 * q[0] / q[2] + 75.0;
    const double at_v = 122.0 * q[1] / q[2] + 41.0;
    if (at_u < 0.0 || at_u >= 150.0 || at_v < 0.0 || at_v >= 80.0) {
      EXPECT_EQ(pixel[i], kOutside);
      EXPECT_EQ(seen[i], 0.0F);
      ++outside;
      continue;
    }
    const auto index = static_cast<std::int32_t>(at_v) * 150 + static_cast<std::int32_t>(at_u);
    EXPECT_EQ(pixel[i], index);
    EXPECT_EQ(seen[i], measured[static_cast<std::size_t>(index)]);
    const std::int32_t row = index / 150;
    EXPECT_NEAR(seen_x[i], (index % 150 - 74.5) / 120.0 * static_cast<double>(seen[i]), 1e-6);
    EXPECT_NEAR(seen_y[i], (row - 40.5) / 122.0 * static_cast<double>(seen[i]), 1e-6);
    ++landed;
  }
  EXPECT_GT(landed, 40);
  EXPECT_GT(outside, 3);
  EXPECT_LT(undecided, 3);
}

TEST_F(ReprojectionTest, WhatLandsOnABorderOfPixelsIsUndecided) {
  motion = {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, 0}};
  lay_row(20);
  land_points();
  for (std::size_t i = 0; i < kPoints; ++i) {
    EXPECT_EQ(pixel[i], kUndecided) << i;
  }
}

TEST_F(ReprojectionTest, WhatLiesBehindTheCameraIsNowhere) {
  motion.translation[2] = -3.0F;
  land_points();
  for (std::size_t i = 0; i < kPoints; ++i) {
    EXPECT_TRUE(pixel[i] == kOutside || pixel[i] == kUndecided) << i;
    EXPECT_EQ(seen[i], 0.0F);
  }
}

TEST_F(ReprojectionTest, SeenThroughIsWhatWasMeasuredFarBehindOrIsUndecided) {
  land_points();
  const PointNoise noise{0.001F, 0.002F, 0.0F, 0.0F};
  constexpr float kZone = 30.0F;
  ByPoint<std::uint32_t> found;
  const std::size_t count = free_space_violations(
      {expected.data(), seen_x.data(), seen_y.data(), seen.data(), pixel.data()}, kPoints, noise,
      kZone, found.data());
  std::vector<std::uint32_t> wanted;
  for (std::uint32_t u = 0; u < kPoints; ++u) {
    const float sigma = 0.001F + 0.002F * expected[u] * expected[u];
    if (pixel[u] == kUndecided || (pixel[u] >= 0 && seen[u] - expected[u] > kZone * sigma)) {
      wanted.push_back(u);
    }
  }
  EXPECT_EQ(std::vector<std::uint32_t>(found.begin(), found.begin() + count), wanted);
  EXPECT_GT(count, 5U);
}

TEST_F(ReprojectionTest, EveryInstructionSetLandsInTheSamePixels) {
  land_points();
  const auto first = pixel;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    land_points();
    for (std::size_t u = 0; u < kPoints; ++u) {
      EXPECT_TRUE(pixel[u] == first[u] || pixel[u] == kUndecided || first[u] == kUndecided)
          << hwy::TargetName(target);
    }
  }
  hwy::SetSupportedTargetsForTest(0);
}

}  // namespace
}  // namespace lockbox::kernels
