// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/kernels/contours.hpp"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace lockbox::kernels {
namespace {

constexpr float kNoDepth = std::numeric_limits<float>::infinity();
constexpr float kDepth = 1.2F;
constexpr float kDepthStep = 0.01F;

/// A plane that is seen aslant; what `ends` says lies beyond its contour.
class NormalVoteTest : public ::testing::Test {
 protected:
  static constexpr PixelPlane kPlane{kDepth, 0.02F, -0.01F};

  template <typename Ends>
  void draw(const Ends& ends, float beyond = kNoDepth) {
    for (int row = 0; row < kVoteRows; ++row) {
      for (int column = 0; column < kVoteColumns; ++column) {
        const int du = column - kVoteReach;
        const int dv = row - kVoteReach;
        const float there = kDepth / (1.0F + kPlane.slope_u * static_cast<float>(du) +
                                      kPlane.slope_v * static_cast<float>(dv));
        depths[static_cast<std::size_t>(row * kVoteColumns + column)] =
            ends(du, dv) ? there + beyond : there;
      }
    }
  }

  NormalVote vote() const { return normal_vote(depths.data(), kVoteColumns, kPlane, kDepthStep); }

  std::array<float, std::size_t{kVoteRows} * kVoteColumns> depths{};
};

TEST_F(NormalVoteTest, APlaneThatGoesOnHasNoContour) {
  draw([](int, int) { return false; });
  EXPECT_EQ(vote().u, 0);
  EXPECT_EQ(vote().v, 0);
}

TEST_F(NormalVoteTest, PointsToWhereThePlaneEnds) {
  draw([](int du, int) { return du > 0; });
  EXPECT_GT(vote().u, NormalVote::kUnit);
  EXPECT_EQ(vote().v, 0);
  draw([](int du, int dv) { return du + dv < -1; });
  EXPECT_LT(vote().u, 0);
  EXPECT_EQ(vote().u, vote().v);
}

TEST_F(NormalVoteTest, NearNeighboursSayMore) {
  draw([](int du, int dv) { return du == 1 && dv == 0; });
  EXPECT_EQ(vote().u, NormalVote::kUnit);
  draw([](int du, int dv) { return du == 3 && dv == 0; });
  EXPECT_EQ(vote().u, NormalVote::kUnit / 3);
  draw([](int du, int dv) { return du == 3 && dv == 3; });
  EXPECT_EQ(vote().u, 0) << "beyond reach";
}

TEST_F(NormalVoteTest, OnlyWhatLiesFartherByTheStepCounts) {
  const auto right = [](int du, int) { return du > 0; };
  draw(right, 0.9F * kDepthStep * kDepth);
  EXPECT_EQ(vote().u, 0);
  draw(right, 1.1F * kDepthStep * kDepth);
  EXPECT_GT(vote().u, 0);
  draw(right, -0.2F);
  EXPECT_EQ(vote().u, 0) << "nearer";
}

TEST_F(NormalVoteTest, TheLastColumnDoesNotCount) {
  draw([](int du, int) { return du == kVoteReach + 1; });
  EXPECT_EQ(vote().u, 0);
}

/// Three rows of a plane that is seen aslant, of a length that no number of lanes divides. It is
/// bent, steps and ends.
class FindBendsTest : public ::testing::Test {
 protected:
  static constexpr std::size_t kWidth = 53;
  static constexpr float kBend = 2e-5F;  // 1 / metre

  FindBendsTest() {
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t u = 0; u < kWidth; ++u) {
        const float step = u < 35 ? 0.0F : 0.05F;
        rows[row][u] = 1.0F / (0.8F + 0.004F * static_cast<float>(u) -
                               0.007F * static_cast<float>(row) - step);
      }
      rows[row][50] = kNoDepth;
    }
    rows[1][20] += 1e-4F;
  }

  std::vector<std::int32_t> bends(std::size_t first, std::size_t end) const {
    std::vector<std::int32_t> columns(end - first + kLanes);
    columns.resize(find_bends({rows[0].data(), rows[1].data(), rows[2].data()}, first, end, kBend,
                              columns.data()));
    return columns;
  }

  std::array<std::array<float, kWidth>, 3> rows;
};

TEST_F(FindBendsTest, FindsWhereTheDepthIsBentOrStepsButNotWhereItEnds) {
  EXPECT_EQ(bends(1, kWidth - 1), (std::vector<std::int32_t>{19, 20, 21, 34, 35}));
  EXPECT_EQ(bends(20, 35), (std::vector<std::int32_t>{20, 21, 34}));
  EXPECT_TRUE(bends(20, 20).empty());
}

TEST_F(FindBendsTest, EveryInstructionSetFindsTheSame) {
  const auto first = bends(1, kWidth - 1);
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    EXPECT_EQ(bends(1, kWidth - 1), first) << hwy::TargetName(target);
  }
  hwy::SetSupportedTargetsForTest(0);
}

/// Labels change at column 33, and right below column 45.
class FindEdgesTest : public ::testing::Test {
 protected:
  static constexpr std::size_t kWidth = 53;

  FindEdgesTest() {
    for (auto& row : rows) row.fill(1.0F);
    for (auto& row : labels) row.fill(2);
    rows[1][10] = 1.002F;  // stands out, and its neighbours before and behind it do
    rows[0][25] = 1.001F;  // less than the step
    for (auto& row : labels) std::fill(row.begin() + 33, row.end(), std::int16_t{-1});
    labels[2][45] = 5;
  }

  std::vector<std::int32_t> edges(std::size_t first, std::size_t end) const {
    constexpr float kLeastStep = 0.0015F;
    std::vector<std::int32_t> columns(end - first + kLanes);
    columns.resize(find_edges({rows[0].data(), rows[1].data(), rows[2].data()},
                              {labels[0].data(), labels[1].data(), labels[2].data()}, first, end,
                              kLeastStep, columns.data()));
    return columns;
  }

  std::array<std::array<float, kWidth>, 3> rows;
  std::array<std::array<std::int16_t, kWidth>, 3> labels;
};

TEST_F(FindEdgesTest, FindsWhereLabelsChangeAndDepthBends) {
  EXPECT_EQ(edges(1, kWidth - 1), (std::vector<std::int32_t>{9, 10, 11, 32, 33, 45}));
  EXPECT_EQ(edges(12, 33), (std::vector<std::int32_t>{32}));
}

TEST_F(FindEdgesTest, EveryInstructionSetFindsTheSame) {
  const auto first = edges(1, kWidth - 1);
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    EXPECT_EQ(edges(1, kWidth - 1), first) << hwy::TargetName(target);
  }
  hwy::SetSupportedTargetsForTest(0);
}

TEST_F(NormalVoteTest, EveryInstructionSetVotesTheSame) {
  draw([](int du, int dv) { return 2 * du - dv > 1; });
  const NormalVote first = vote();
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    EXPECT_EQ(vote().u, first.u) << hwy::TargetName(target);
    EXPECT_EQ(vote().v, first.v) << hwy::TargetName(target);
  }
  hwy::SetSupportedTargetsForTest(0);
}

}  // namespace
}  // namespace lockbox::kernels
