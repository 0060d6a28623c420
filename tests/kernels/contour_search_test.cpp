// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/kernels/contour_search.hpp"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <array>
#include <cmath>
#include <vector>

namespace lockbox::kernels {
namespace {

constexpr int kWidth = 120;
constexpr int kHeight = 90;
constexpr double kFocal = 150.0;
constexpr double kCentre[2] = {59.5, 44.5};
constexpr float kNear = 1.0F;  // metres: a plate that ends at a column, before a wall
constexpr float kWall = 1.4F;
constexpr double kPixel = 1.0 / kFocal;  // metres

/// The right edge of a plate that is seen to end between two columns; contour points along it.
class ContourSearchTest : public ::testing::Test {
 protected:
  static constexpr std::size_t kPoints = 35;  // one in each row from the sixth on

  ContourSearchTest() : depth(std::size_t{kWidth} * kHeight) { draw(); }

  /// The last column that shows the plate.
  void draw(int last = 70) {
    for (std::size_t i = 0; i < depth.size(); ++i) {
      depth[i] = static_cast<int>(i % kWidth) <= last ? kNear : kWall;
    }
  }

  void set(int column, float value) {
    for (int row = 0; row < kHeight; ++row) {
      depth[static_cast<std::size_t>(row * kWidth + column)] = value;
    }
  }

  struct Seen {
    double offset;
    double variance;
  };

  /// With the model's edge at that column, in fractions of a pixel; all points see the same.
  Seen sought_from(double column) const {
    std::array<std::vector<double>, 11> arrays;
    for (auto& array : arrays) array.resize(padded(kPoints));
    for (std::size_t i = 0; i < padded(kPoints); ++i) {
      const double row = 6.0 + static_cast<double>(std::min(i, kPoints - 1));
      arrays[0][i] = (column - kCentre[0]) * kPixel;
      arrays[1][i] = (row - kCentre[1]) * kPixel;
      arrays[2][i] = static_cast<double>(kNear);
      arrays[3][i] = 1.0;
    }
    const auto from = [&](std::size_t k) { return arrays[k].data(); };
    ContourPose still{};
    for (int axis = 0; axis < 3; ++axis) still.rotation[4 * axis] = 1.0;
    search_contours({{from(0), from(1), from(2)},
                     {from(3), from(4), from(5)},
                     from(6),
                     from(7),
                     from(8),
                     padded(kPoints)},
                    still,
                    {depth.data(), {kFocal, kFocal}, {kCentre[0], kCentre[1]}, kWidth, kHeight},
                    search, {from(9), from(10)});
    for (std::size_t i = 1; i < kPoints; ++i) {
      EXPECT_NEAR(arrays[9][i], arrays[9][0], 1e-12);
      EXPECT_NEAR(arrays[10][i], arrays[10][0], 1e-12);
    }
    return {arrays[9][0], arrays[10][0]};
  }

  ContourSearch search{0.0003, 0.002, 0.5, 0.02, 4.0, 3.0};
  std::vector<float> depth;
};

constexpr double kLateral2 = 0.25 * kPixel * kPixel;

TEST_F(ContourSearchTest, PassesBetweenTheSurfaceAndWhatLiesBeyond) {
  for (const double column : {70.5, 68.1, 73.7, 79.2, 62.0}) {
    const Seen seen = sought_from(column);
    EXPECT_NEAR(seen.offset, (70.5 - column) * kPixel, 1e-6) << column;
    EXPECT_NEAR(seen.variance, kLateral2, 1e-6 * kLateral2) << column;
  }
}

TEST_F(ContourSearchTest, AGapOfOnePixelIsAsUncertainAsItIsWide) {
  set(71, 0.0F);
  const Seen seen = sought_from(70.2);
  EXPECT_NEAR(seen.offset, (71.0 - 70.2) * kPixel, 1e-6);
  EXPECT_NEAR(seen.variance, kLateral2 + kPixel * kPixel / 12.0, 1e-6 * kLateral2);
  set(72, 0.0F);
  EXPECT_EQ(sought_from(70.2).variance, 0.0) << "a shadow";
}

TEST_F(ContourSearchTest, WhereTheSurfaceGoesOnNothingIsSeen) {
  draw(kWidth);
  EXPECT_EQ(sought_from(60.0).variance, 0.0);
}

TEST_F(ContourSearchTest, WhereSomethingNearerComesInBetweenNothingIsSeen) {
  set(71, 0.8F);
  EXPECT_EQ(sought_from(69.0).variance, 0.0);
}

TEST_F(ContourSearchTest, BeyondTheImageNothingIsSeen) {
  draw(kWidth);
  EXPECT_EQ(sought_from(kWidth - 2.0).variance, 0.0);
}

TEST_F(ContourSearchTest, IsAtLeastMostOfTheWayInwardsIfNothingButTheWallIsSeen) {
  draw(10);
  const double reach = search.gate * std::hypot(0.5 * kPixel, search.annealing_sigma);
  const Seen seen = sought_from(70.0);
  EXPECT_NEAR(seen.offset, -0.75 * reach, 1e-6);
  EXPECT_GT(seen.variance, 0.0);
}

/// Half of a faint step counts as well, once what lies beyond has been seen.
TEST_F(ContourSearchTest, NoiseDoesNotSpeakForOneSide) {
  const float zone = 3.0F * (0.0003F + 0.002F);
  for (int column = 71; column < kWidth; ++column) set(column, kNear + 1.2F * zone);
  set(71, kNear + 0.9F * zone);  // still within the zone, but nearer to what lies beyond
  EXPECT_NEAR(sought_from(70.5).offset, 0.0, 1e-6);
}

TEST_F(ContourSearchTest, EveryInstructionSetSeesTheSame) {
  set(71, 0.0F);
  const Seen first = sought_from(69.3);
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    const Seen seen = sought_from(69.3);
    EXPECT_NEAR(seen.offset, first.offset, 1e-12) << hwy::TargetName(target);
    EXPECT_NEAR(seen.variance, first.variance, 1e-12) << hwy::TargetName(target);
  }
  hwy::SetSupportedTargetsForTest(0);
}

}  // namespace
}  // namespace lockbox::kernels
