// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/core/number_text.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace lockbox {
namespace {

TEST(NumberText, IsReadWholeOrNotAtAll) {
  EXPECT_EQ(parse_number("-1.5e3"), -1500.0);
  EXPECT_EQ(parse_number("+2"), 2.0);
  for (const char* text : {"", "+", "+-1", "1,5", "1.5 ", " 1", "0x10", "one", "1e999999"}) {
    EXPECT_FALSE(parse_number(text)) << text;
  }
}

TEST(NumberText, NanAndInfinityAreNumbersButNotFinite) {
  EXPECT_TRUE(std::isnan(parse_number("nan").value()));
  EXPECT_EQ(parse_number("inf"), std::numeric_limits<double>::infinity());
  EXPECT_FALSE(parse_finite_number("nan"));
  EXPECT_FALSE(parse_finite_number("-inf"));
  EXPECT_EQ(parse_finite_number("0.25"), 0.25);
}

TEST(NumberText, ComesBackAsTheSameValue) {
  for (const double value :
       {0.1, -1.0 / 3.0, 1e-300, 1e300, 123456789.125, -0.0, std::numeric_limits<double>::max()}) {
    EXPECT_EQ(parse_number(number_text(value)), value);
    EXPECT_EQ(parse_number(fixed_number_text(value)), value);
    EXPECT_EQ(fixed_number_text(value).find('e'), std::string::npos);
  }
  EXPECT_EQ(number_text(-std::numeric_limits<double>::quiet_NaN()), "nan");
}

}  // namespace
}  // namespace lockbox
