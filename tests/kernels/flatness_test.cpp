// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/kernels/flatness.hpp"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace lockbox::kernels {
namespace {

constexpr float kNothing = std::numeric_limits<float>::infinity();

/// Three rows of a plane that is seen aslant, of a length that no number of lanes divides.
class FindFlatTest : public ::testing::Test {
 protected:
  static constexpr std::size_t kWidth = 53;
  static constexpr float kBend = 2e-5F;  // 1 / metre

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

}  // namespace
}  // namespace lockbox::kernels
