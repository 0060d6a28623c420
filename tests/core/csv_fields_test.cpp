// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/core/csv_fields.hpp"

#include <gmock/gmock.h>

namespace lockbox {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(CsvFields, AreTrimmedAndMayBeEmpty) {
  EXPECT_THAT(split_fields(" a,,b c \r"), ElementsAre("a", "", "b c"));
  EXPECT_THAT(split_fields(""), ElementsAre(""));
}

TEST(Words, AreDividedByWhiteSpaceOfAnyLength) {
  EXPECT_THAT(split_words("  1.5\t-2  x\r\n"), ElementsAre("1.5", "-2", "x"));
  EXPECT_THAT(split_words("one"), ElementsAre("one"));
}

TEST(Words, AreNoneInWhiteSpaceAlone) {
  EXPECT_THAT(split_words(" \t \n"), IsEmpty());
  EXPECT_THAT(split_words(""), IsEmpty());
}

}  // namespace
}  // namespace lockbox
