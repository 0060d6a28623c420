// SPDX-License-Identifier: BSD-3-Clause
// Files of options, given with --config.
#include <gmock/gmock.h>

#include <filesystem>
#include <string>

#include "temporary_folder.hpp"
#include "tool.hpp"

namespace lockbox {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Configuration, WithUnknownKeysOrMissingIsRefused) {
  const TemporaryFolder folder;
  const auto file = (folder / "options.toml").string();
  EXPECT_EQ(run_tool({"inspect", "--config", file}).status, 3);
  write_text(file, "model = \"rigid_block\"\nmodle = \"x\"\n");
  const auto result = run_tool({"inspect", "--config", file});
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(result.errors, HasSubstr(file + ":2: there is no option 'modle'"));
  EXPECT_THAT(result.errors, HasSubstr("did you mean model?"));
  write_text(file, "[inspect]\nmodel = \"rigid_block\"\n");
  EXPECT_THAT(run_tool({"inspect", "--config", file}).errors, HasSubstr("[sections] are not read"));
  EXPECT_THAT(run_tool({"inspect", "--config", "no.toml"}).errors, HasSubstr("no such file"));
}

TEST(Configuration, WithAValueThatIsNoneIsRefusedWithItsLine) {
  const TemporaryFolder folder;
  const auto file = (folder / "options.toml").string();
  const auto refusal = [&](const std::string& options) {
    write_text(file, "# of a test\nthreads = 2\n" + options + "\n");
    const auto result =
        run_tool({"track", "--model", "rigid_block", "--source", "x.oni", "--config", file});
    EXPECT_EQ(result.status, 3) << result.errors;
    return result.errors;
  };
  const std::string line = file + ":3: ";
  EXPECT_THAT(refusal("iterations = nan"), HasSubstr(line + "--iterations: 'nan' is not a"));
  EXPECT_THAT(refusal("fixed-base = perhaps"), HasSubstr(line + "--fixed-base: 'perhaps' is"));
  EXPECT_THAT(refusal("fixed-base = [true, true]"), HasSubstr(line + "--fixed-base: 'true,true'"));
  EXPECT_THAT(refusal("iterations = 1 2"), HasSubstr(line + "--iterations can be given only once"));
  EXPECT_THAT(refusal("collision = \"letter\""), HasSubstr("is none of"));
  EXPECT_THAT(refusal("help = true"), HasSubstr(line + "--help belongs on the command line"));
  EXPECT_THAT(refusal("two words = 1"), HasSubstr(line + "there is no option 'two words'"));
  EXPECT_THAT(refusal(std::string("sensor = \0", 10)), HasSubstr(line + "is no text"));
}

TEST(Configuration, IsNamedWhereAValueOfItIsRefusedLater) {
  const TemporaryFolder folder;
  const auto file = (folder / "options.toml").string();
  write_text(file, "model = \"rigid_blok\"\n");
  const auto result = run_tool({"inspect", "--config", file});
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(result.errors, HasSubstr("rigid_blok: there is no such file"));
  EXPECT_THAT(result.errors, HasSubstr("(given in " + file + ":1)"));
}

TEST(Configuration, IsNotBlamedForTheCommandLine) {
  const TemporaryFolder folder;
  const auto file = (folder / "options.toml").string();
  write_text(file, "iterations = 4\n");
  const auto result = run_tool({"track", "--iterations", "nan", "--config", file});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.errors, Not(HasSubstr(file)));
}

TEST(Configuration, GivesOptionsTheirValues) {
  const TemporaryFolder folder;
  const auto file = (folder / "options.toml").string();
  const auto picture = folder / "picture.png";
  write_text(file, "model = \"rigid_block\"\npicture = \"" + picture.string() + "\"\n");
  const auto result = run_tool({"inspect", "--config", file});
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_TRUE(std::filesystem::exists(picture));
}

}  // namespace
}  // namespace lockbox
