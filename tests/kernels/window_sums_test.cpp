// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/kernels/window_sums.hpp"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <random>
#include <vector>

namespace lockbox::kernels {
namespace {

constexpr std::size_t kSumColumns = 2 * kWindowBlock;
constexpr std::size_t kSumRows = 13;
constexpr std::size_t kNextRow = kSumColumns + 41;
constexpr std::size_t kMapRows = kSumRows + 9;

class WindowSumsTest : public ::testing::Test {
 protected:
  WindowSumsTest() : maps(2, std::vector<std::int16_t>(kNextRow * kMapRows)) {
    std::mt19937 random(3);
    std::uniform_int_distribution<int> number(-14, 8);
    for (auto& map : maps) {
      for (auto& cell : map) cell = static_cast<std::int16_t>(number(random));
    }
    std::uniform_int_distribution<std::size_t> x(0, kNextRow - kSumColumns);
    std::uniform_int_distribution<std::size_t> y(0, kMapRows - kSumRows);
    for (std::size_t i = 0; i < 200; ++i) {
      first.push_back(maps[i % 2].data() + y(random) * kNextRow + x(random));
    }
  }

  std::vector<std::vector<std::int16_t>> maps;
  std::vector<const std::int16_t*> first;
};

TEST_F(WindowSumsTest, AreThoseOfALoopWithEveryInstructionSet) {
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    SCOPED_TRACE(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    std::vector<std::int16_t> sums(kSumColumns * kSumRows + 1, 77);
    add_windows({first, kNextRow, kSumColumns, kSumRows}, sums.data());
    for (std::size_t row = 0; row < kSumRows; ++row) {
      for (std::size_t column = 0; column < kSumColumns; ++column) {
        int expected = 0;
        for (const std::int16_t* window : first) expected += window[row * kNextRow + column];
        ASSERT_EQ(sums[row * kSumColumns + column], expected) << row << ", " << column;
      }
    }
    EXPECT_EQ(sums.back(), 77) << "written beyond the sums";
  }
  hwy::SetSupportedTargetsForTest(0);
}

TEST_F(WindowSumsTest, OfNoWindowsAreZero) {
  std::vector<std::int16_t> sums(kSumColumns * kSumRows, 77);
  add_windows({{}, kNextRow, kSumColumns, kSumRows}, sums.data());
  EXPECT_EQ(sums, std::vector<std::int16_t>(kSumColumns * kSumRows, 0));
}

}  // namespace
}  // namespace lockbox::kernels
