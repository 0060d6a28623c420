// SPDX-License-Identifier: BSD-3-Clause
// An object whose size does not fit is not tracked in silence.
#include <gmock/gmock.h>

#include <regex>

#include "tool.hpp"

namespace lockbox {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

/// How a rigid block is tracked that deviates like this, from where it is.
struct TrackedSize {
  ToolResult result;
  std::string states;
  std::string description;
};

TrackedSize tracked(const TemporaryFolder& folder, const std::string& name,
                    const std::string& deviation) {
  write_text(folder / (name + ".yaml"), deviation);
  const ToolResult simulated =
      run_tool({"simulate", "--model", "rigid_block", "--trajectory", "auto", "--frames", "25",
                "--scene", "room", "--seed", "77", "--deviation", folder / (name + ".yaml"),
                "--output", folder / name});
  EXPECT_EQ(simulated.status, 0) << simulated.errors;
  const std::filesystem::path run = folder / (name + "_run");
  const ToolResult result =
      run_tool({"track", "--model", "rigid_block", "--source", folder / name, "--initial-state",
                folder / (name + "/groundtruth.csv"), "--output", run.string()});
  return {result, read_text(run / "states.csv"), read_text(run / "run.yaml")};
}

double number_after(const std::string& text, const std::string& key) {
  const std::regex pattern(key + R"(: ([-+0-9.e]+))");
  std::smatch match;
  return std::regex_search(text, match, pattern) ? std::stod(match[1]) : 0.0;
}

TEST(Size, ThatFitsIsNoReasonToWarn) {
  const TemporaryFolder folder;
  const TrackedSize run = tracked(folder, "exact", "object: {scale: 1.0}\n");
  EXPECT_THAT(run.result.errors, Not(HasSubstr("warning")));
  EXPECT_THAT(run.result.output, Not(HasSubstr("looks")));
  EXPECT_THAT(run.states, Not(HasSubstr("uncertain")));
  EXPECT_NEAR(number_after(run.description, "across"), 1.0, 0.003);
}

TEST(Size, OfTheDepthsIsSaidWithSizeSignAndCauses) {
  const TemporaryFolder folder;
  const TrackedSize run = tracked(folder, "deep", "depth: {scale: 1.05}\n");
  EXPECT_THAT(run.result.errors, HasSubstr("% (+- "));
  EXPECT_THAT(run.result.errors, HasSubstr("larger than its model"));
  EXPECT_THAT(run.result.errors, HasSubstr("--mesh-scale"));
  EXPECT_THAT(run.result.errors, HasSubstr("--depth-scale"));
  EXPECT_THAT(run.result.errors, ContainsRegex("focal length[^\n]*its relief speaks against it"));
  EXPECT_THAT(run.states.substr(run.states.size() / 2), Not(HasSubstr("tracking")));
  EXPECT_NEAR(number_after(run.description, "across"), 1.05, 0.005);
  EXPECT_NEAR(number_after(run.description, "along"), 1.05, 0.03);
}

TEST(Size, OfTheFocalLengthIsToldFromIt) {
  const TemporaryFolder folder;
  const TrackedSize run = tracked(folder, "wide", "camera: {focal_length: 1.06}\n");
  EXPECT_THAT(run.result.errors, HasSubstr("larger than its model"));
  EXPECT_THAT(run.result.errors, HasSubstr("the focal length: times 1.0"));
  EXPECT_THAT(run.result.errors, ContainsRegex("--mesh-scale.; its relief speaks against it"));
}

/// What a failed search says otherwise is no reason beside it.
TEST(Size, ThatExplainsWhyNothingIsTrackedIsTheOnlyReasonSaid) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_tool({"simulate", "--model", "rigid_block", "--trajectory", "auto", "--frames", "6",
                      "--scene", "room", "--seed", "77", "--output", folder / "room"})
                .status,
            0);
  const auto result = run_tool(
      {"track", "--model", "rigid_block", "--source", folder / "room", "--depth-scale", "909"});
  EXPECT_EQ(result.status, 5);
  EXPECT_THAT(result.errors, HasSubstr("larger than its model; it is not called tracking"));
  EXPECT_THAT(result.errors, Not(HasSubstr("not found up to")));
  EXPECT_THAT(result.errors, Not(HasSubstr("check these")));
  EXPECT_THAT(result.errors, ContainsRegex("not found for certain in any of 6 frames:\n"
                                           "  the object looks [0-9.]+ % .*larger"));
}

TEST(Size, OffByWhatCamerasAreIsTrackedAndSummedUp) {
  const TemporaryFolder folder;
  const TrackedSize run = tracked(folder, "moderate", "object: {scale: 0.98}\n");
  EXPECT_THAT(run.result.errors, Not(HasSubstr("warning")));
  EXPECT_THAT(run.result.output, HasSubstr("smaller than its model: scale of the model"));
  EXPECT_NEAR(number_after(run.description, "across"), 0.98, 0.005);
}

}  // namespace
}  // namespace lockbox
