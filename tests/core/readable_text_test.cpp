// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/core/readable_text.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace lockbox {
namespace {

TEST(ReadableText, HasNoExponentAndFewDigits) {
  EXPECT_EQ(readable_number(0.0), "0");
  EXPECT_EQ(readable_number(-0.0), "0");
  EXPECT_EQ(readable_number(1.0 / 3.0), "0.333");
  EXPECT_EQ(readable_number(-1.5707963, 5), "-1.5708");
  EXPECT_EQ(readable_number(100.0), "100");
  EXPECT_EQ(readable_number(1.23456e7), "12300000");
  EXPECT_EQ(readable_number(2.5e-8), "0.000000025");
  EXPECT_EQ(readable_number(std::numeric_limits<double>::infinity()), "inf");
  EXPECT_EQ(readable_number(std::numeric_limits<double>::quiet_NaN()), "nan");
  EXPECT_EQ(readable_number(1e-300), "0");
  EXPECT_EQ(readable_number(1e300), "1e+300");
}

TEST(ReadableText, TellsLengthsInTheUnitThatSuitsThem) {
  EXPECT_EQ(readable_length(0.0), "0 m");
  EXPECT_EQ(readable_length(2e-7), "0.2 um");
  EXPECT_EQ(readable_length(0.0003), "300 um");
  EXPECT_EQ(readable_length(0.001), "1 mm");
  EXPECT_EQ(readable_length(0.0125), "12.5 mm");
  EXPECT_EQ(readable_length(-0.38), "-380 mm");
  EXPECT_EQ(readable_length(0.99999), "1 m");
  EXPECT_EQ(readable_length(60.0), "60 m");
  EXPECT_EQ(readable_length(400000.0), "400000 m");
}

}  // namespace
}  // namespace lockbox
