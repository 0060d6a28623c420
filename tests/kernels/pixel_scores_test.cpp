// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/kernels/pixel_scores.hpp"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace lockbox::kernels {
namespace {

constexpr float kNothing = std::numeric_limits<float>::infinity();

/// Three rows in which a plane across the view, 1 m away, is drawn and measured; of a length that
/// no number of lanes divides.
class PixelScoresTest : public ::testing::Test {
 protected:
  static constexpr std::size_t kWidth = 53;
  static constexpr float kSigma = 0.003F;  // of a depth at 1 m, metres

  PixelScoresTest() {
    for (auto& row : drawn) row.fill(1.0F);
    for (auto& row : labels) row.fill(2);
    measured.fill(1.0F);
    nearest.fill(1.0F);
  }

  std::vector<float> scores() const {
    std::vector<float> all(kWidth - 2, 7.0F);
    score_pixels({drawn[0].data(), drawn[1].data(), drawn[2].data()},
                 {labels[0].data(), labels[1].data(), labels[2].data()},
                 {measured.data(), nearest.data()}, 1, kWidth - 1, scoring, all.data());
    return all;
  }

  /// Of the pixel in that column.
  float score(std::size_t u) const { return scores()[u - 1]; }

  std::array<std::array<float, kWidth>, 3> drawn{};
  std::array<std::array<std::int16_t, kWidth>, 3> labels{};
  std::array<float, kWidth> measured{};
  std::array<float, kWidth> nearest{};
  PixelScoring scoring{kSigma, 0.0F, 100.0F, 0.0F, -0.15F, -6.0F};
};

TEST_F(PixelScoresTest, WhatIsMeasuredWhereItIsDrawnIsExplained) {
  for (const float score : scores()) EXPECT_FLOAT_EQ(score, 1.0F);
}

TEST_F(PixelScoresTest, FallWithTheSquareOfTheDeviation) {
  measured[20] += 2.0F * kSigma;
  EXPECT_NEAR(score(20), 1.0F - 0.22F * 4.0F, 1e-3F);
  scoring.slack = kSigma;  // as large again
  EXPECT_NEAR(score(20), 1.0F - 0.22F * 2.0F, 1e-3F);
}

TEST_F(PixelScoresTest, WhatStandsBeforeCountsLessThanWhatIsSeenThrough) {
  measured[20] = nearest[20] = 0.5F;
  measured[30] = nearest[30] = 1.5F;
  measured[40] = 1.5F;  // with a neighbour that is near enough
  EXPECT_FLOAT_EQ(score(20), scoring.occluded);
  EXPECT_FLOAT_EQ(score(30), scoring.violating);
  EXPECT_FLOAT_EQ(score(40), 0.0F);
}

TEST_F(PixelScoresTest, AreNoneWhereNothingIsDrawnOrMeasured) {
  drawn[1][20] = kNothing;
  labels[1][20] = -1;
  measured[30] = 0.0F;
  EXPECT_EQ(score(20), 0.0F);
  EXPECT_EQ(score(30), 0.0F);
}

TEST_F(PixelScoresTest, AreNoneOfWhatStandsBeforeTheReach) {
  measured[20] = nearest[20] = 0.5F;
  scoring.reach = 0.6F;
  EXPECT_EQ(score(20), 0.0F);
  EXPECT_FLOAT_EQ(score(21), 1.0F);
}

/// On a slope a depth is as uncertain as where in its pixel it was taken. A step to another body is
/// none.
TEST_F(PixelScoresTest, AreTolerantOnSlopesOfOneBodyAlone) {
  measured[20] = nearest[20] = 1.02F;
  EXPECT_LT(score(20), -1.0F);
  drawn[1][19] = drawn[1][21] = 1.04F;
  EXPECT_NEAR(score(20), 1.0F - 0.22F * 0.02F * 0.02F / (0.25F * 0.04F * 0.04F + kSigma * kSigma),
              1e-3F);
  drawn[1][21] = 1.0F;  // the smaller of both
  EXPECT_LT(score(20), -1.0F);
  drawn[1][21] = 1.04F;
  labels[1][19] = labels[1][21] = 3;
  EXPECT_LT(score(20), -1.0F);
}

TEST_F(PixelScoresTest, EveryInstructionSetGivesTheSame) {
  for (std::size_t u = 0; u < kWidth; ++u) {
    drawn[1][u] += 0.001F * static_cast<float>(u % 5);
    measured[u] += 0.002F * static_cast<float>(u % 7);
    nearest[u] = measured[u] - 0.001F * static_cast<float>(u % 3);
    labels[2][u] = static_cast<std::int16_t>(u % 11 == 0 ? 1 : 2);
  }
  const std::vector<float> first = scores();
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    const std::vector<float> other = scores();
    for (std::size_t i = 0; i < first.size(); ++i) {
      EXPECT_NEAR(other[i], first[i], 1e-3F * (1.0F + std::abs(first[i])))
          << hwy::TargetName(target);
    }
  }
  hwy::SetSupportedTargetsForTest(0);
}

}  // namespace
}  // namespace lockbox::kernels
