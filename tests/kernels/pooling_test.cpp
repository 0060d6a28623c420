// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/kernels/pooling.hpp"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace lockbox::kernels {
namespace {

constexpr float kNothing = std::numeric_limits<float>::infinity();

/// Three rows of a plane that is seen aslant, of a length that no number of lanes divides.
class FindFlatTest : public ::testing::Test {
 protected:
  static constexpr std::size_t kWidth = 53;
  static constexpr float kBend = 2e-5F;

  FindFlatTest() {
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t u = 0; u < kWidth; ++u) {
        depths[row][u] =
            1.0F / (0.8F + 0.004F * static_cast<float>(u) - 0.007F * static_cast<float>(row));
      }
      labels[row].fill(3);
    }
  }

  /// The columns that are not.
  std::vector<std::size_t> bent() const {
    std::vector<std::uint8_t> flat(kWidth - 2, 2);
    find_flat({depths[0].data(), depths[1].data(), depths[2].data()},
              {labels[0].data(), labels[1].data(), labels[2].data()}, 1, kWidth - 1, kBend,
              flat.data());
    std::vector<std::size_t> columns;
    for (std::size_t i = 0; i < flat.size(); ++i) {
      EXPECT_LE(flat[i], 1);
      if (flat[i] == 0) columns.push_back(i + 1);
    }
    return columns;
  }

  std::array<std::array<float, kWidth>, 3> depths{};
  std::array<std::array<std::int16_t, kWidth>, 3> labels{};
};

TEST_F(FindFlatTest, APlaneIsSeenAslant) {
  EXPECT_TRUE(bent().empty());
}

TEST_F(FindFlatTest, ABendOrAStepIsNotNorAreItsNeighboursAcross) {
  depths[1][20] += 1e-4F;
  depths[0][40] -= 1e-4F;
  EXPECT_EQ(bent(), (std::vector<std::size_t>{19, 20, 21, 40}));
  depths[1][20] -= 0.95e-4F;  // less than may bend
  EXPECT_EQ(bent(), (std::vector<std::size_t>{40}));
}

TEST_F(FindFlatTest, WhereAnotherBodyBeginsOrNothingIsThereIsNot) {
  labels[1][10] = 4;
  labels[2][30] = 4;
  for (std::size_t row = 0; row < 3; ++row) {
    depths[row][50] = kNothing;
    labels[row][50] = -1;
  }
  EXPECT_EQ(bent(), (std::vector<std::size_t>{9, 10, 11, 30, 49, 50, 51}));
}

TEST_F(FindFlatTest, EveryInstructionSetFindsTheSame) {
  depths[1][20] += 1e-4F;
  labels[1][47] = 4;
  const auto first = bent();
  ASSERT_FALSE(first.empty());
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    EXPECT_EQ(bent(), first) << hwy::TargetName(target);
  }
  hwy::SetSupportedTargetsForTest(0);
}

/// Pixels that err by two thousandths, of a plane that lies elsewhere than expected.
class PooledDeviationTest : public ::testing::Test {
 protected:
  static constexpr float kGate = 0.008F;
  static constexpr float kReach = 2.0F * kGate;
  static constexpr NearnessPlane kExpected{0.8F, 0.003F, -0.002F};
  static constexpr std::size_t kStride = 70;
  static constexpr std::size_t kRows = 64;

  void measure(float deviation, float noise = 0.002F) {
    depths.resize(kStride * kRows);
    std::mt19937 random(5);
    std::normal_distribution<float> normal(0.0F, noise);
    for (std::size_t i = 0; i < depths.size(); ++i) {
      const float nearness = kExpected.first +
                             kExpected.per_column * static_cast<float>(i % kStride) +
                             kExpected.per_row * static_cast<float>(i / kStride);
      depths[i] = (1.0F + deviation + normal(random)) / nearness;
    }
  }

  PooledDeviation pooled(std::size_t width, std::size_t height) const {
    return pool_deviations({depths.data(), kStride, width, height}, kExpected, kReach, kGate);
  }

  std::vector<float> depths;
};

TEST_F(PooledDeviationTest, AreTheMeanAndTheVarianceOfTheBlock) {
  measure(0.0F);
  const PooledDeviation found = pooled(64, 64);
  EXPECT_NEAR(found.pixels, 64.0F * 64.0F, 4.0F) << "one of 16,000 errs by four deviations";
  EXPECT_NEAR(found.mean, 0.0F, 4.0F * 0.002F / 64.0F);
  EXPECT_NEAR(std::sqrt(found.variance), 0.002F, 1e-4F);
}

TEST_F(PooledDeviationTest, AreNotDrawnToWhereThePlaneIsExpected) {
  measure(0.007F);  // where a gate around the plane would leave out a third
  EXPECT_NEAR(pooled(64, 64).mean, 0.007F, 4.0F * 0.002F / 64.0F);
}

TEST_F(PooledDeviationTest, LeaveOutHolesAndWhatStandsBefore) {
  measure(0.001F, 0.0F);
  for (std::size_t i = 0; i < depths.size(); i += 5) depths[i] = 0.0F;
  for (std::size_t i = 1; i < depths.size(); i += 5) depths[i] *= 0.9F;
  const PooledDeviation found = pooled(64, 10);
  EXPECT_EQ(found.pixels, 10.0F * 38.0F);
  EXPECT_NEAR(found.mean, 0.001F, 1e-6F);
}

TEST_F(PooledDeviationTest, OfNothingAreNone) {
  measure(0.1F);
  EXPECT_EQ(pooled(16, 16).pixels, 0.0F);
}

TEST_F(PooledDeviationTest, EveryInstructionSetAndWidthSaysTheSame) {
  measure(0.002F);
  for (const std::size_t width : {1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 64}) {
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t row = 0; row < 5; ++row) {
      for (std::size_t u = 0; u < width; ++u) {
        const float nearness = kExpected.first + kExpected.per_column * static_cast<float>(u) +
                               kExpected.per_row * static_cast<float>(row);
        sum += static_cast<double>(depths[row * kStride + u] * nearness - 1.0F);
        count += 1.0;
      }
    }
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
      hwy::SetSupportedTargetsForTest(target);
      const PooledDeviation found = pooled(width, 5);
      EXPECT_EQ(static_cast<double>(found.pixels), count) << hwy::TargetName(target);
      EXPECT_NEAR(static_cast<double>(found.mean), sum / count, 1e-6) << hwy::TargetName(target);
    }
    hwy::SetSupportedTargetsForTest(0);
  }
}

}  // namespace
}  // namespace lockbox::kernels
