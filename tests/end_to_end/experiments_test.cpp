// SPDX-License-Identifier: BSD-3-Clause
// The smallest version of each experiment that is done in one go: its rows, and its summary.
#include <gmock/gmock.h>

#include <signal.h>

#include <algorithm>
#include <chrono>
#include <set>
#include <thread>

#include "small_experiment.hpp"
#include "tool.hpp"

namespace lockbox {
namespace {

using testing::HasSubstr;

TEST(Creep, ShowsWhatIsNotDeterminedAtRest) {
  const TemporaryFolder folder;
  run_experiment("creep", "carton_pair", folder / "out", {"--frames", "14"});
  const auto rows = read_rows(folder / "out/creep_carton_pair.csv");
  ASSERT_EQ(rows.size(), 4U);
  for (const auto& row : rows) {
    const bool is_packed = row.at("scene") == "packed";
    EXPECT_EQ(row.at("tracking"), is_packed ? "0" : "14");
    EXPECT_EQ(row.at("base_is_determined"), is_packed ? "0" : "1");
    EXPECT_EQ(row.at("joints_determined"), is_packed ? "0" : "1");
    if (row.at("noise") != "repeated") continue;
    EXPECT_LT(number(row, "base_mm"), 0.1);
    EXPECT_LT(number(row, "base_degrees"), 0.01);
    EXPECT_LT(number(row, "joints"), 1e-4);
  }
}

TEST(Rigid, FollowsEachStartOverAllFrames) {
  const TemporaryFolder folder;
  const auto summary =
      run_experiment("rigid", "lockbox", folder / "out", {"--frames", "2", "--step", "30"});
  const auto rows = read_rows(folder / "out/rigid_lockbox.csv");
  ASSERT_EQ(rows.size(), 8U);
  EXPECT_EQ(number(rows.back(), "start"), 0.9);
  EXPECT_LT(number(rows[1], "translation"), 0.002);  // where it began
  EXPECT_THAT(summary, HasSubstr("of 4 starts"));
}

TEST(Intersection, ComparesTheModesAndAnswersToItsOldName) {
  const TemporaryFolder folder;
  run_experiment("collision", "cabinet", folder / "out", {"--frames", "4"});
  std::set<std::string> modes;
  for (const NamedRow& row : read_rows(folder / "out/intersection_cabinet.csv")) {
    modes.insert(row.at("collision"));
  }
  EXPECT_EQ(modes, (std::set<std::string>{"off", "literal", "eroded"}));
}

TEST(Order, DoesNotMatter) {
  const TemporaryFolder folder;
  const auto summary =
      run_experiment("order", "cabinet", folder / "out", {"--runs", "1", "--frames", "3"});
  const auto rows = read_rows(folder / "out/order_cabinet.csv");
  ASSERT_EQ(rows.size(), 6U);
  for (const NamedRow& row : rows) EXPECT_EQ(number(row, "difference"), 0.0);
  EXPECT_THAT(summary, HasSubstr("bit-identical in 1 of 1"));
  const auto original = read_text(std::filesystem::path(LOCKBOX_MODELS) / "cabinet/cabinet.urdf");
  EXPECT_THAT(original, testing::Not(HasSubstr("part_0")));
  EXPECT_THAT(read_text(folder / "out/order_cabinet/renamed0/cabinet.urdf"), HasSubstr("part_0"));
}

TEST(Kidnap, FollowsBothKindsToTheEnd) {
  const TemporaryFolder folder;
  const auto summary =
      run_experiment("kidnap", "rigid_block", folder / "out", {"--runs", "1", "--live-runs", "1"});
  const auto rows = read_rows(folder / "out/kidnap_rigid_block.csv");
  ASSERT_EQ(rows.size(), 60U);
  EXPECT_EQ(rows.front().at("kind"), "covered");
  EXPECT_EQ(rows.back().at("kind"), "thrown");
  EXPECT_GT(number(rows.front(), "searches"), 0.0);
  EXPECT_THAT(summary, HasSubstr("of 1 runs"));
  EXPECT_THAT(summary, HasSubstr("frames called tracking: "));
  const auto live = read_rows(folder / "out/kidnap_rigid_block_live.csv");
  ASSERT_EQ(live.size(), 1U);
  EXPECT_GT(number(live.front(), "seconds"), 0.0);
  EXPECT_THAT(summary, HasSubstr("live: found in 1 of 1 runs"));
}

TEST(Kidnap, SaysWhatAnInterruptionLoses) {
  const TemporaryFolder folder;
  const std::string output = folder / "out";
  Tool tool({"experiment", "kidnap", "--model", "rigid_block", "--output", output});
  while (!std::filesystem::exists(output)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  tool.send_signal(SIGINT);
  const auto result = tool.wait();
  EXPECT_EQ(result.status, 128 + SIGINT);
  EXPECT_THAT(result.errors, HasSubstr("Ctrl-C loses them"));
  EXPECT_THAT(result.errors, HasSubstr("ended by SIGINT: the runs of the model at hand are lost"));
}

TEST(Occlusion, ComparesWithTheRunWithoutTheArm) {
  const TemporaryFolder folder;
  const auto summary = run_experiment("occlusion", "cabinet", folder / "out", {"--frames", "5"});
  const auto rows = read_rows(folder / "out/occlusion_cabinet.csv");
  double hidden = 0.0;
  for (const NamedRow& row : rows) {
    if (row.at("frame") == "0") {  // the arm is not there yet
      EXPECT_EQ(row.at("error"), row.at("error_without_arm"));
    }
    hidden = std::max(hidden, number(row, "occluded"));
  }
  EXPECT_GT(hidden, 0.05);
  EXPECT_THAT(summary, HasSubstr("hidden at most"));
}

TEST(Speed, GrowsFromRunToRunAndStepsOnce) {
  const TemporaryFolder folder;
  const auto summary = run_experiment("speed", "cabinet", folder / "out",
                                      {"--frames", "16", "--fastest", "2", "--runs", "1"});
  const auto rows = read_rows(folder / "out/speed_cabinet.csv");
  ASSERT_EQ(rows.size(), 24U);
  // Sampled at so few frames, the largest speed of a smooth motion grows by less than its rate.
  EXPECT_GT(number(rows.back(), "turning_speed"), 1.1 * number(rows.front(), "turning_speed"));
  const auto steps = read_rows(folder / "out/speed_cabinet_steps.csv");
  ASSERT_EQ(steps.size(), 20U);
  EXPECT_EQ(steps.back().at("kind"), "hinge");
  EXPECT_THAT(summary, HasSubstr("step of a hinge by 20 degrees"));
}

TEST(Experiment, RefusesAShardThatIsNone) {
  const TemporaryFolder folder;
  const auto result = run_tool(
      {"experiment", "convergence", "--output", (folder / "out").string(), "--shard", "3/2"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.errors, HasSubstr("--shard"));
}

TEST(Experiment, WithoutANameIsRefused) {
  const auto result = run_tool({"experiment", "--output", "out"});
  EXPECT_EQ(result.status, 2);
}

/// Of the tool and of the program that it calls.
TEST(Experiment, SaysTheSameWhereverItIsCalled) {
  const std::vector<std::vector<std::string>> calls = {
      {"--help"}, {"help"}, {"peers", "--help"}, {"pears"}, {}};
  for (const auto& call : calls) {
    auto arguments = call;
    const ToolResult own = Tool(arguments, {}, {}, LOCKBOX_EXPERIMENT).wait();
    arguments.insert(arguments.begin(), "experiment");
    const ToolResult called = run_tool(arguments);
    EXPECT_EQ(called.status, own.status);
    EXPECT_EQ(called.output, own.output);
    EXPECT_EQ(called.errors, own.errors);
  }
}

TEST(Experiment, IsOneProcessWithTheToolThatCallsIt) {
  const TemporaryFolder folder;
  const std::string output = folder / "out";
  Tool tool({"experiment", "kidnap", "--model", "rigid_block", "--output", output});
  while (!std::filesystem::exists(output)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_EQ(tool.program().filename(), "lockbox-experiment");
  tool.send_signal(SIGTERM);
  EXPECT_EQ(tool.wait().status, 128 + SIGTERM);
}

}  // namespace
}  // namespace lockbox
