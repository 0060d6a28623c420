// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include "tool.hpp"

namespace lockbox {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

const std::vector<std::string> kCommands = {"track",      "simulate", "record", "evaluate",
                                            "experiment", "inspect",  "view"};

TEST(Help, ListsAllCommands) {
  const auto result = run_tool({"--help"});
  EXPECT_EQ(result.status, 0);
  for (const auto& command : kCommands) EXPECT_THAT(result.output, HasSubstr("  " + command + " "));
}

TEST(Help, OfEachCommandShowsItsOptionsAndAnExample) {
  for (const auto& command : kCommands) {
    const auto result = run_tool({command, "--help"});
    EXPECT_EQ(result.status, 0) << command;
    EXPECT_THAT(result.output, HasSubstr("Example:\n  lockbox " + command + " "));
    EXPECT_THAT(result.output, HasSubstr("--config"));
    EXPECT_THAT(result.errors, IsEmpty());
  }
}

TEST(Version, IsSaid) {
  const auto result = run_tool({"--version"});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.output, testing::ContainsRegex("^lockbox [0-9]+\\.[0-9]+\\.[0-9]+"));
}

TEST(Usage, UnknownOptionsAreRefusedByName) {
  for (const auto& command : kCommands) {
    const auto result = run_tool({command, "--no-such-option"});
    EXPECT_EQ(result.status, 2) << command;
    EXPECT_THAT(result.errors, HasSubstr("lockbox " + command + " --help"));
  }
  EXPECT_THAT(run_tool({"inspect", "--model", "lockbox", "--no-such-option"}).errors,
              HasSubstr("--no-such-option"));
}

TEST(Usage, MissingOptionsAreNamed) {
  const auto result = run_tool({"track", "--source", "x.oni"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.errors, HasSubstr("--model"));
}

TEST(Usage, ValuesOutOfRangeAreRefused) {
  const std::vector<std::vector<std::string>> wrong = {
      {"--iterations", "0"},  {"--threads", "-1"},      {"--iterations", "three"},
      {"--collision", "x"},   {"--max-frames", "-1"},   {"--record", "frames.png"},
      {"--depth-scale", "0"}, {"--depth-scale", "nan"}, {"--snapshot-interval", "0"}};
  for (const auto& option : wrong) {
    auto arguments = option;
    arguments.insert(arguments.begin(), {"track", "--model", "lockbox", "--source", "x.oni"});
    const auto result = run_tool(arguments);
    EXPECT_EQ(result.status, 2) << option[0];
    EXPECT_THAT(result.errors, HasSubstr(option[0]));
    EXPECT_THAT(result.errors, HasSubstr(option[1]));
    EXPECT_THAT(result.errors, testing::SizeIs(testing::Lt(120U))) << "is that readable?";
  }
}

TEST(Output, ThatIsLostIsAFailure) {
  Tool tool({"--help"}, {}, "/dev/full");
  const auto result = tool.wait();
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(result.errors, HasSubstr("standard output"));
}

TEST(Usage, UnknownAndMissingCommandsAreRefusedWithTheList) {
  for (const auto& arguments : std::vector<std::vector<std::string>>{{"trakc"}, {}}) {
    const auto result = run_tool(arguments);
    EXPECT_EQ(result.status, 2);
    EXPECT_THAT(result.errors, HasSubstr("inspect"));
  }
}

}  // namespace
}  // namespace lockbox
