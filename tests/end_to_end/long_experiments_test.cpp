// SPDX-License-Identifier: BSD-3-Clause
// The smallest version of each experiment that continues where it was stopped.
#include <gmock/gmock.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <thread>

#include "small_experiment.hpp"
#include "tool.hpp"

namespace lockbox {
namespace {

using testing::HasSubstr;

const std::vector<std::string> kFewStarts = {"--samples", "1",  "--step",   "45",
                                             "--frames",  "12", "--joints", "free"};

TEST(Convergence, HasARowForEachStartAndSumsThemUp) {
  const TemporaryFolder folder;
  const auto summary = run_experiment("convergence", "rigid_block", folder / "out", kFewStarts);
  const auto rows = read_rows(folder / "out/convergence_rigid_block_primesense_12frames_seed1.csv");
  ASSERT_EQ(rows.size(), 8U);  // 2 trackers, 2 translations, 2 rotations
  for (const NamedRow& row : rows) {
    if (number(row, "start_translation_cm") > 0 || number(row, "start_rotation_degrees") > 0) {
      continue;
    }
    EXPECT_LT(number(row, "translation"), 0.003);
    EXPECT_EQ(row.at("searches"), "0");
    EXPECT_EQ(row.at("status"), "tracking");
  }
  EXPECT_THAT(summary, HasSubstr("whole tracker, joints free"));
  EXPECT_THAT(summary, HasSubstr("re-initialised from within 5 cm and 5 degrees: 0 of 1"));
  EXPECT_THAT(summary, HasSubstr("half of the runs succeed up to"));
}

TEST(Convergence, ContinuesWhereItWasCutOff) {
  const TemporaryFolder folder;
  const auto file = folder / "out/convergence_rigid_block_primesense_12frames_seed1.csv";
  run_experiment("convergence", "rigid_block", folder / "out", kFewStarts);
  const std::string whole = read_text(file);
  std::filesystem::resize_file(file, whole.size() - 10);
  run_experiment("convergence", "rigid_block", folder / "out", kFewStarts);
  EXPECT_EQ(read_text(file), whole);
}

TEST(Convergence, ShardsSumUpToTheWhole) {
  const TemporaryFolder folder;
  std::string summary;
  for (const char* shard : {"1/2", "2/2"}) {
    auto options = kFewStarts;
    options.insert(options.end(), {"--shard", shard, "--tracker", "registration"});
    summary = run_experiment("convergence", "rigid_block", folder / "out", options);
  }
  EXPECT_THAT(summary, HasSubstr("of 4 ("));
}

TEST(Accuracy, HasARowForEachUnknownAndContinuesWhereItWasCutOff) {
  const TemporaryFolder folder;
  const auto run = [&](const std::string& scenes) {
    return run_experiment("accuracy", "cabinet", folder / "out", {"--scenes", scenes});
  };
  run("1");
  const auto file = folder / "out/accuracy_cabinet_primesense_20000points_seed1.csv";
  const auto first = read_text(file);
  EXPECT_THAT(run("2"), HasSubstr("error/allowed"));
  EXPECT_EQ(read_text(file).substr(0, first.size()), first);
  const auto rows = read_rows(file);
  ASSERT_EQ(rows.size(), 2U * 10U);
  for (const NamedRow& row : rows) {
    if (row.at("observable") == "0") continue;
    EXPECT_GT(number(row, "bound"), 0.0);
    EXPECT_LT(std::abs(number(row, "error")), 5.0 * number(row, "sigma")) << row.at("unknown");
  }
}

TEST(Mismatch, HasARowForEachFrameAndContinuesWhereItWasStopped) {
  const TemporaryFolder folder;
  const auto run = [&](const std::string& seeds) {
    return run_experiment("mismatch", "rigid_block", folder / "out",
                          {"--kind", "none", "--kind", "centre", "--kind", "joints", "--severity",
                           "severe", "--seeds", seeds, "--frames", "3"});
  };
  run("1");
  const auto file = folder / "out/mismatch_rigid_block_severe_primesense_3frames.csv";
  const auto first = read_text(file);
  const auto summary = run("2");
  EXPECT_EQ(read_text(file).substr(0, first.size()), first);
  const auto rows = read_rows(file);
  ASSERT_EQ(rows.size(), 12U);  // the block has no joints
  for (const NamedRow& row : rows) {
    EXPECT_EQ(row.at("right"), "1");
    EXPECT_LT(number(row, "translation"), 0.01);
    // 12 pixels at about a metre: what no tracker can know is not counted, but told.
    if (row.at("kind") != "centre") continue;
    EXPECT_GT(number(row, "plain_translation"), 0.012);
  }
  EXPECT_THAT(summary, HasSubstr("rigid_block, severe"));
  EXPECT_THAT(
      read_text(folder / "out/mismatch_rigid_block_severe_primesense_3frames_centre_seed2.yaml"),
      HasSubstr("principal_point: ["));
}

TEST(Mismatch, LooksThroughOtherSensors) {
  const TemporaryFolder folder;
  run_experiment("mismatch", "rigid_block", folder / "out",
                 {"--kind", "stereo", "--kind", "time-of-flight", "--seeds", "1", "--frames", "2"});
  const auto rows = read_rows(folder / "out/mismatch_rigid_block_moderate_primesense_2frames.csv");
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows.front().at("kind"), "stereo");
  EXPECT_EQ(rows.back().at("kind"), "time-of-flight");
  EXPECT_LT(number(rows.back(), "translation"), 0.02);
}

TEST(Absent, EndsWithinASecondOfASignalThoughTheObjectIsSought) {
  const TemporaryFolder folder;
  Tool tool({"experiment", "absent", "--model", "lockbox", "--rooms", "4", "--near-misses", "0",
             "--output", folder / "out"});
  std::this_thread::sleep_for(std::chrono::seconds(5));  // a search takes longer
  const auto signalled = std::chrono::steady_clock::now();
  tool.send_signal(SIGTERM);
  const auto result = tool.wait();
  EXPECT_EQ(result.status, 128 + SIGTERM) << result.errors;
  EXPECT_LT(std::chrono::steady_clock::now() - signalled, std::chrono::seconds(2));
}

/// The block itself as the recording: where it is found, that counts as a false alarm.
TEST(Absent, CountsClaimsInRoomsAndRecordingsAndContinuesWhereItWasStopped) {
  const TemporaryFolder folder;
  const ToolResult simulated =
      run_tool({"simulate", "--model", "rigid_block", "--trajectory", "auto", "--frames", "2",
                "--output", (folder / "recordings/block.oni").string(), "--quiet"});
  ASSERT_EQ(simulated.status, 0) << simulated.errors;
  write_text(folder / "recordings/broken.oni", "no recording");
  const auto run = [&](const std::string& rooms) {
    return run_experiment("absent", "rigid_block", folder / "out",
                          {"--rooms", rooms, "--near-misses", "1", "--frames", "1", "--recording",
                           (folder / "recordings").string(), "--max-frames", "1"});
  };
  run("1");
  const auto file = folder / "out/absent_rigid_block_primesense_1frames_seed1.csv";
  const auto first = read_text(file);
  const auto summary = run("2");
  EXPECT_EQ(read_text(file).substr(0, first.size()), first);
  const auto rows = read_rows(file);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows.front().at("kind"), "furniture");
  EXPECT_EQ(rows[1].at("kind"), "missing-part");
  EXPECT_EQ(rows.back().at("kind"), "boxes");
  for (const NamedRow& row : rows) EXPECT_GT(number(row, "seconds"), 0.0);
  const auto recorded = read_rows(folder / "out/absent_rigid_block_recorded_1frames.csv");
  ASSERT_EQ(recorded.size(), 1U);
  EXPECT_EQ(recorded.front().at("status"), "tracking");
  EXPECT_THAT(summary, HasSubstr("false alarm: recording"));
  const auto is_picture = [](const auto& entry) {
    const std::string name = entry.path().filename().string();
    return name.find("_recording_") != std::string::npos && name.ends_with("block.oni_0_claim.png");
  };
  const std::filesystem::directory_iterator written(folder / "out");
  EXPECT_TRUE(std::any_of(begin(written), end(written), is_picture));
}

TEST(ForeignObjects, HaveRowsAndFilesToSimulateThemAgainAndContinueWhereTheyWereStopped) {
  const TemporaryFolder folder;
  const auto run = [&](const std::string& pieces) {
    const ToolResult result =
        run_tool({"experiment", "boards", "--block", "tune", "--pieces", pieces, "--deviation",
                  "third", "--output", (folder / "out").string(), "--quiet"});
    EXPECT_EQ(result.status, 0) << result.errors;
    return result.output;
  };
  const std::string stem = "out/boards_tune_third_1frames_seed1";
  EXPECT_THAT(run("1"), HasSubstr("boards, tune, deviation third: right in"));
  const auto first = read_text(folder / (stem + ".csv"));
  run("2");
  EXPECT_EQ(read_text(folder / (stem + ".csv")).substr(0, first.size()), first);
  const auto rows = read_rows(folder / (stem + ".csv"));
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].at("right"), "1");
  // Two equal disks on an oblong board, which looks the same after half a turn.
  EXPECT_EQ(number(rows[1], "right") + number(rows[1], "looks_equal"), 1.0);
  for (const NamedRow& row : rows) {
    EXPECT_EQ(row.at("right"), row.at("wrong").empty() ? "1" : "0");
    EXPECT_GT(number(row, "evidence_of_truth"), 0.0);
  }
  const auto piece = folder / (stem + "/1");
  const ToolResult again = run_tool(
      {"simulate", "--model", (piece / "model.urdf").string(), "--trajectory",
       (piece / "truth.csv").string(), "--scene", (piece / "scene.yaml").string(), "--deviation",
       (piece / "deviation.yaml").string(), "--output", (folder / "again").string(), "--quiet"});
  EXPECT_EQ(again.status, 0) << again.errors;
}

TEST(ForeignObjects, OfAHouseholdAreNamed) {
  const TemporaryFolder folder;
  const ToolResult result = run_tool({"experiment", "household", "--pieces", "1", "--output",
                                      (folder / "out").string(), "--quiet"});
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_THAT(result.output, HasSubstr("household, tune, deviation none: right in"));
  const auto rows = read_rows(folder / "out/household_tune_none_1frames_seed1.csv");
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].at("kind"), "laptop");
}

TEST(ForeignObjects, DrawTheirOwnModels) {
  const TemporaryFolder folder;
  const ToolResult result = run_tool({"experiment", "furniture", "--model", "lockbox", "--output",
                                      (folder / "out").string(), "--quiet"});
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(result.errors, HasSubstr("leave it out"));
}

TEST(ForeignObjects, ComeFromBlocksThatThereAre) {
  const TemporaryFolder folder;
  const ToolResult result = run_tool({"experiment", "furniture", "--block", "test", "--output",
                                      (folder / "out").string(), "--quiet"});
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(result.errors, HasSubstr("test:1"));
}

TEST(Shapes, HaveRowsAndContinueWhereTheyWereStopped) {
  const TemporaryFolder folder;
  const auto run = [&](const std::string& pieces) {
    const ToolResult result = run_tool({"experiment", "shapes", "--block", "tune", "--pieces",
                                        pieces, "--output", (folder / "out").string(), "--quiet"});
    EXPECT_EQ(result.status, 0) << result.errors;
    return result.output;
  };
  const auto file = folder / "out/shapes_tune_primesense_seed1.csv";
  run("2");
  const auto first = read_text(file);
  EXPECT_THAT(run("3"), HasSubstr("shapes, tune: right in"));
  EXPECT_EQ(read_text(file).substr(0, first.size()), first);
  const auto rows = read_rows(file);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[2].at("kind"), "elbow");
  EXPECT_EQ(rows[2].at("right"), "1");
}

}  // namespace
}  // namespace lockbox
