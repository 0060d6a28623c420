// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/core/stamp_unit.hpp"

#include <gtest/gtest.h>

namespace lockbox {
namespace {

/// Stamps of a camera at so many frames a second, in a unit, from a time in seconds.
std::vector<double> stamps(double first, double rate, double per_second) {
  std::vector<double> result;
  result.reserve(20);
  for (int i = 0; i < 20; ++i) {
    result.push_back((first + i / rate) * per_second);
  }
  return result;
}

TEST(StampUnit, SecondsOfAnyCameraAreLeftAlone) {
  for (const double first : {0.0, 100.0, 1.3e9, 1.8e9}) {
    for (const double rate : {0.5, 1.0, 30.0, 90.0}) {
      EXPECT_FALSE(other_stamp_unit(stamps(first, rate, 1.0))) << first << " " << rate;
    }
  }
  EXPECT_FALSE(other_stamp_unit({}));
  EXPECT_FALSE(other_stamp_unit({12.0}));
  EXPECT_FALSE(other_stamp_unit({12.0, 11.0, 12.0}));
}

TEST(StampUnit, OtherUnitsSince1970AreCertain) {
  for (const double per_second : {1e3, 1e6, 1e9}) {
    for (const double rate : {0.01, 1.0, 30.0}) {
      const auto unit = other_stamp_unit(stamps(1.7e9, rate, per_second));
      ASSERT_TRUE(unit) << per_second;
      EXPECT_EQ(unit->per_second, per_second);
      EXPECT_TRUE(unit->certain);
    }
  }
}

TEST(StampUnit, OtherUnitsFromZeroFollowFromTheFramePeriod) {
  for (const double per_second : {1e3, 1e6, 1e9}) {
    for (const double rate : {2.0, 30.0, 90.0}) {
      const auto unit = other_stamp_unit(stamps(0.0, rate, per_second));
      ASSERT_TRUE(unit) << per_second << " " << rate;
      EXPECT_EQ(unit->per_second, per_second);
      EXPECT_EQ(unit->certain, per_second != 1e3);
    }
  }
}

}  // namespace
}  // namespace lockbox
