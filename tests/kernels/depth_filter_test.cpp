// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/kernels/depth_filter.hpp"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace lockbox::kernels {
namespace {

constexpr std::size_t kFilteredWidth = 53;  // that no number of lanes divides

/// Three rows, with a pixel more at both ends; some pixels were not measured.
class DepthFilterTest : public ::testing::Test {
 protected:
  DepthFilterTest() {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> depth(0.97F, 1.03F);
    for (auto& row : rows) {
      for (float& value : row) value = random() % 5 == 0 ? 0.0F : depth(random);
    }
    rows[1][8] = 0.3F;
    rows[1][50] = 2.5F;
  }

  std::vector<float> kept(const DepthFilter& filter) const {
    std::vector<float> result(kFilteredWidth, -1.0F);
    filter_depths({&rows[0][1], &rows[1][1], &rows[2][1]}, kFilteredWidth, filter, result.data());
    return result;
  }

  static bool hangs(float before, float depth, float after, float jump) {
    return before > 0.0F && after > 0.0F && std::abs(depth - before) > jump &&
           std::abs(depth - after) > jump;
  }

  std::array<std::array<float, kFilteredWidth + 2>, 3> rows;
};

TEST_F(DepthFilterTest, KeepsWhatIsInRangeAndDoesNotFlyWithEveryInstructionSet) {
  constexpr DepthFilter kFilter{0.5F, 2.0F, 0.02F};
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    SCOPED_TRACE(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    const std::vector<float> found = kept(kFilter);
    int dropped = 0;
    for (std::size_t u = 0; u < kFilteredWidth; ++u) {
      const float depth = rows[1][u + 1];
      const float jump = kFilter.jump_factor * depth * depth;
      const bool flies = hangs(rows[1][u], depth, rows[1][u + 2], jump) ||
                         hangs(rows[0][u + 1], depth, rows[2][u + 1], jump);
      const bool is_kept = depth >= kFilter.min_depth && depth <= kFilter.max_depth && !flies;
      EXPECT_EQ(found[u], is_kept ? depth : 0.0F) << u;
      dropped += depth > 0.0F && !is_kept ? 1 : 0;
    }
    EXPECT_GT(dropped, 5);
    EXPECT_LT(dropped, 40);
  }
  hwy::SetSupportedTargetsForTest(0);
}

TEST_F(DepthFilterTest, AnInfiniteJumpKeepsWhatFlies) {
  const std::vector<float> found = kept({0.0F, 5.0F, std::numeric_limits<float>::infinity()});
  for (std::size_t u = 0; u < kFilteredWidth; ++u) EXPECT_EQ(found[u], rows[1][u + 1]) << u;
}

TEST(ScaleDepths, GivesMetresWithEveryInstructionSet) {
  std::vector<std::uint16_t> units(kFilteredWidth);
  for (std::size_t i = 0; i < kFilteredWidth; ++i) units[i] = static_cast<std::uint16_t>(1260 * i);
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    SCOPED_TRACE(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    std::vector<float> metres(kFilteredWidth, -1.0F);
    scale_depths(units.data(), kFilteredWidth, 0.001F, metres.data());
    for (std::size_t i = 0; i < kFilteredWidth; ++i) {
      EXPECT_EQ(metres[i], static_cast<float>(units[i]) * 0.001F) << i;
    }
  }
  hwy::SetSupportedTargetsForTest(0);
}

}  // namespace
}  // namespace lockbox::kernels
