// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/kernels/reprojection.hpp"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <array>
#include <cmath>
#include <vector>

namespace lockbox::kernels {
namespace {

/// One row of a z-buffer in which two bodies and gaps take turns; the measured image has another
/// size than the z-buffer, and its depths tell the pixels apart.
class ReprojectionTest : public ::testing::Test {
 protected:
  static constexpr std::size_t kColumns = 75;  // no multiple of any number of lanes
  static constexpr Intrinsics kDrawn{60.0F, 61.0F, 37.0F, 20.0F, 75, 40};
  static constexpr Intrinsics kMeasured{120.0F, 122.0F, 74.5F, 40.5F, 150, 80};

  ReprojectionTest() : measured(150 * 80) {
    for (std::size_t i = 0; i < measured.size(); ++i) {
      measured[i] = 1.0F + 1e-4F * static_cast<float>(i);
    }
    for (std::size_t u = 0; u < kColumns; ++u) {
      id[u] = static_cast<std::int16_t>(u / 7 % 3) - 1;
      depth[u] = id[u] < 0 ? INFINITY : 0.9F + 0.003F * static_cast<float>(u);
    }
  }

  void reproject_row(std::int32_t row) {
    reproject({depth.data(), id.data(), kColumns, row}, kDrawn, motion,
              {measured.data(), kMeasured}, {expected.data(), seen.data(), pixel.data()});
  }

  std::array<float, kColumns> depth;
  std::array<std::int16_t, kColumns> id;
  std::vector<float> measured;
  // The first body has come nearer, the second was turned by a hundredth and moved far aside.
  std::array<RigidMotion, 2> motion{{{{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0.002F, -0.001F, -0.05F}},
                                     {{1, -0.01F, 0, 0.01F, 1, 0, 0, 0, 1}, {0.3F, 0.0F, 0.0F}}}};
  std::array<float, padded(kColumns)> expected;
  std::array<float, padded(kColumns)> seen;
  std::array<std::int32_t, padded(kColumns)> pixel;
};

TEST_F(ReprojectionTest, PointsLandInThePixelThatSeesThem) {
  constexpr std::int32_t kRow = 9;
  reproject_row(kRow);
  int landed = 0;
  int outside = 0;
  int undecided = 0;
  for (std::size_t u = 0; u < kColumns; ++u) {
    if (id[u] < 0) {
      EXPECT_EQ(pixel[u], kOutside);
      continue;
    }
    const RigidMotion& m = motion[static_cast<std::size_t>(id[u])];
    const double z = static_cast<double>(depth[u]);
    const double p[3] = {(static_cast<double>(u) - 37.0) / 60.0 * z, (kRow - 20.0) / 61.0 * z, z};
    double q[3];
    for (int i = 0; i < 3; ++i) {
      q[i] = static_cast<double>(m.translation[i]);
      for (int j = 0; j < 3; ++j) {
        q[i] += static_cast<double>(m.rotation[3 * i + j]) * p[j];
      }
    }
    EXPECT_NEAR(expected[u], q[2], 1e-6);
    if (pixel[u] == kUndecided) {
      ++undecided;
      continue;
    }
    const double at_u = 120.0 * q[0] / q[2] + 75.0;
    const double at_v = 122.0 * q[1] / q[2] + 41.0;
    if (at_u < 0.0 || at_u >= 150.0 || at_v < 0.0 || at_v >= 80.0) {
      EXPECT_EQ(pixel[u], kOutside);
      EXPECT_EQ(seen[u], 0.0F);
      ++outside;
      continue;
    }
    const auto index = static_cast<std::int32_t>(at_v) * 150 + static_cast<std::int32_t>(at_u);
    EXPECT_EQ(pixel[u], index);
    EXPECT_EQ(seen[u], measured[static_cast<std::size_t>(index)]);
    ++landed;
  }
  EXPECT_GT(landed, 20);
  EXPECT_GT(outside, 3);
  EXPECT_LT(undecided, 3);
}

TEST_F(ReprojectionTest, WhatLandsOnABorderOfPixelsIsUndecided) {
  motion[0] = {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, 0}};
  // Pixel (u, v) of the z-buffer is (2 u + 0.5, 2 v + 0.5) of the image: a corner of four pixels.
  reproject_row(20);
  for (std::size_t u = 0; u < kColumns; ++u) {
    if (id[u] == 0) {
      EXPECT_EQ(pixel[u], kUndecided) << u;
    }
  }
}

TEST_F(ReprojectionTest, WhatLiesBehindTheCameraIsNowhere) {
  for (RigidMotion& m : motion) {
    m.translation[2] = -3.0F;
  }
  reproject_row(9);
  for (std::size_t u = 0; u < kColumns; ++u) {
    EXPECT_TRUE(pixel[u] == kOutside || pixel[u] == kUndecided) << u;
    EXPECT_EQ(seen[u], 0.0F);
  }
}

TEST_F(ReprojectionTest, SeenThroughIsWhatWasMeasuredFarBehindOrIsUndecided) {
  reproject_row(9);
  const PointNoise noise{0.001F, 0.002F, 0.0F, 0.0F};
  constexpr float kZone = 30.0F;
  std::array<std::uint32_t, padded(kColumns)> found;
  const std::size_t count = seen_through({expected.data(), seen.data(), pixel.data()}, kColumns,
                                         noise, kZone, found.data());
  std::vector<std::uint32_t> wanted;
  for (std::uint32_t u = 0; u < kColumns; ++u) {
    const float sigma = 0.001F + 0.002F * expected[u] * expected[u];
    if (pixel[u] == kUndecided || (pixel[u] >= 0 && seen[u] - expected[u] > kZone * sigma)) {
      wanted.push_back(u);
    }
  }
  EXPECT_EQ(std::vector<std::uint32_t>(found.begin(), found.begin() + count), wanted);
  EXPECT_GT(count, 5U);
}

TEST_F(ReprojectionTest, EveryInstructionSetLandsInTheSamePixels) {
  reproject_row(9);
  const auto first = pixel;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    reproject_row(9);
    for (std::size_t u = 0; u < kColumns; ++u) {
      EXPECT_TRUE(pixel[u] == first[u] || pixel[u] == kUndecided || first[u] == kUndecided)
          << hwy::TargetName(target);
    }
  }
  hwy::SetSupportedTargetsForTest(0);
}

}  // namespace
}  // namespace lockbox::kernels
