// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/kernels/averaging.hpp"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cmath>
#include <random>
#include <vector>

namespace lockbox::kernels {
namespace {

/// Pixels that err by two thousandths, of a plane that lies elsewhere than expected.
class AveragedDeviationTest : public ::testing::Test {
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
      const std::size_t row = i / kStride;
      const float nearness = kExpected.first +
                             kExpected.per_column * static_cast<float>(i % kStride) +
                             kExpected.per_row * static_cast<float>(row);
      depths[i] = (1.0F + deviation + normal(random)) / nearness;
    }
  }

  AveragedDeviation averaged(std::size_t width, std::size_t height) const {
    return average_deviations({depths.data(), kStride, width, height}, kExpected, kReach, kGate);
  }

  std::vector<float> depths;
};

TEST_F(AveragedDeviationTest, AreTheMeanAndTheVarianceOfTheBlock) {
  measure(0.0F);
  const AveragedDeviation found = averaged(64, 64);
  EXPECT_NEAR(found.pixels, 64.0F * 64.0F, 4.0F) << "one of 16,000 errs by four deviations";
  EXPECT_NEAR(found.mean, 0.0F, 4.0F * 0.002F / 64.0F);
  EXPECT_NEAR(std::sqrt(found.variance), 0.002F, 1e-4F);
}

TEST_F(AveragedDeviationTest, AreNotDrawnToWhereThePlaneIsExpected) {
  measure(0.007F);  // where a gate around the plane would leave out a third
  EXPECT_NEAR(averaged(64, 64).mean, 0.007F, 4.0F * 0.002F / 64.0F);
}

TEST_F(AveragedDeviationTest, LeaveOutHolesAndWhatStandsBefore) {
  measure(0.001F, 0.0F);
  for (std::size_t i = 0; i < depths.size(); i += 5) depths[i] = 0.0F;
  for (std::size_t i = 1; i < depths.size(); i += 5) depths[i] *= 0.9F;
  const AveragedDeviation found = averaged(64, 10);
  EXPECT_EQ(found.pixels, 10.0F * 38.0F);
  EXPECT_NEAR(found.mean, 0.001F, 1e-6F);
}

/// Some sensors leave out rows: the first mean must not depend on which.
TEST_F(AveragedDeviationTest, AreOfTheRowsThatAreMeasured) {
  for (std::size_t kept = 0; kept < 4; ++kept) {
    measure(0.001F, 0.0F);
    for (std::size_t i = 0; i < depths.size(); ++i) {
      if (i / kStride % 4 != kept) depths[i] = 0.0F;
    }
    const AveragedDeviation found = averaged(16, 16);
    EXPECT_EQ(found.pixels, 4.0F * 16.0F) << kept;
    EXPECT_NEAR(found.mean, 0.001F, 1e-6F) << kept;
  }
}

TEST_F(AveragedDeviationTest, OfNothingAreNone) {
  measure(0.1F);
  EXPECT_EQ(averaged(16, 16).pixels, 0.0F);
}

TEST_F(AveragedDeviationTest, EveryInstructionSetAndWidthSaysTheSame) {
  measure(0.002F);
  for (const std::size_t width : {1U, 2U, 3U, 4U, 6U, 8U, 12U, 16U, 24U, 32U, 64U}) {
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
      const AveragedDeviation found = averaged(width, 5);
      EXPECT_EQ(static_cast<double>(found.pixels), count) << hwy::TargetName(target);
      EXPECT_NEAR(static_cast<double>(found.mean), sum / count, 1e-6) << hwy::TargetName(target);
    }
    hwy::SetSupportedTargetsForTest(0);
  }
}

}  // namespace
}  // namespace lockbox::kernels
