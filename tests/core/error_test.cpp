// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/core/error.hpp"

#include <gtest/gtest.h>

namespace lockbox {
namespace {

TEST(InputError, TellsWhereAndWhat) {
  EXPECT_STREQ(InputError("a.obj", 3, "is wrong").what(), "a.obj:3: is wrong");
}

TEST(InputError, TextOfAFileDoesNotSteerATerminal) {
  const std::string title = in_quotes("\x1B]0;mine\x07");
  EXPECT_STREQ(InputError("a.obj", title).what(), "a.obj: '\\x1B]0;mine\\x07'");
  EXPECT_STREQ(InputError("a\rb", "\xC2\x9B 2J").what(), "a\\x0Db: \\xC2\\x9B 2J");
}

TEST(InputError, KeepsLinesAndTextOfOtherLanguages) {
  EXPECT_STREQ(InputError("T\xC3\xBCr.urdf", "one\ntwo\t\xC2\xB0").what(),
               "T\xC3\xBCr.urdf: one\ntwo\t\xC2\xB0");
}

}  // namespace
}  // namespace lockbox
