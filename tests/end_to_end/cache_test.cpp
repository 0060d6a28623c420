// SPDX-License-Identifier: BSD-3-Clause
// lockbox cache.
#include <gmock/gmock.h>

#include "tool.hpp"

namespace lockbox {
namespace {

using testing::HasSubstr;

TEST(Cache, IsToldAndCleared) {
  const TemporaryFolder folder;
  const std::vector<std::string> here = {"XDG_CACHE_HOME=" + folder.path().string()};
  EXPECT_THAT(run_tool({"cache"}, here).output, HasSubstr("lockbox: 0 distance fields, 0.0 MB"));
  ASSERT_EQ(run_tool({"inspect", "--model", "rigid_block"}, here).status, 0);
  EXPECT_THAT(run_tool({"cache"}, here).output, HasSubstr("lockbox: 1 distance field, "));
  const auto cleared = run_tool({"cache", "--clear"}, here);
  EXPECT_EQ(cleared.status, 0);
  EXPECT_THAT(cleared.output, HasSubstr("deleted"));
  EXPECT_THAT(run_tool({"cache"}, here).output, HasSubstr("0 distance fields"));
}

TEST(Cache, IsNoneWhereNobodySaysWhere) {
  const auto told = run_tool({"cache"}, {"XDG_CACHE_HOME=", "HOME="});
  EXPECT_EQ(told.status, 0);
  EXPECT_THAT(told.output, HasSubstr("no distance fields are kept"));
}

}  // namespace
}  // namespace lockbox
