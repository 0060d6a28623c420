// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lockbox {
namespace {

TEST(Statistics, AreOfMagnitudesAndInterpolatePercentiles) {
  const Statistics statistics = summarize({3.0, -4.0});
  EXPECT_EQ(statistics.count, 2U);
  EXPECT_DOUBLE_EQ(statistics.rmse, std::sqrt((9.0 + 16.0) / 2.0));
  EXPECT_DOUBLE_EQ(statistics.median, 3.5);
  EXPECT_DOUBLE_EQ(statistics.percentile_95, 3.95);
  EXPECT_DOUBLE_EQ(statistics.maximum, 4.0);
}

TEST(Statistics, TakeTheMiddleOfAnOddNumberOfErrors) {
  EXPECT_DOUBLE_EQ(summarize({5.0, -1.0, 2.0}).median, 2.0);
}

TEST(Statistics, OfNothingAreUnknown) {
  const Statistics statistics = summarize({});
  EXPECT_EQ(statistics.count, 0U);
  EXPECT_TRUE(std::isnan(statistics.rmse));
  EXPECT_TRUE(std::isnan(statistics.maximum));
}

}  // namespace
}  // namespace lockbox
