// SPDX-License-Identifier: BSD-3-Clause
// The smallest version of each experiment: its rows, and what its summary says about them.
#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "tool.hpp"

namespace lockbox {
namespace {

using testing::HasSubstr;

using NamedRow = std::map<std::string, std::string>;

std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> result;
  std::stringstream stream(line + ",");  // so that an empty last field counts
  for (std::string field; std::getline(stream, field, ',');) result.push_back(field);
  return result;
}

std::vector<NamedRow> read_rows(const std::filesystem::path& file) {
  const auto lines = read_lines(file);
  std::vector<NamedRow> rows;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const auto names = fields(lines.front());
    const auto values = fields(lines[i]);
    EXPECT_EQ(values.size(), names.size()) << file << ", line " << i + 1;
    NamedRow& row = rows.emplace_back();
    for (std::size_t c = 0; c < std::min(names.size(), values.size()); ++c) {
      row[names[c]] = values[c];
    }
  }
  return rows;
}

double number(const NamedRow& row, const std::string& column) {
  return std::stod(row.at(column));
}

/// Runs `lockbox experiment NAME`, and expects it to end well.
std::string run_experiment(const std::string& name, const std::string& model,
                           const std::filesystem::path& output,
                           const std::vector<std::string>& options) {
  std::vector<std::string> arguments = {"experiment",    name,     "--model", model, "--output",
                                        output.string(), "--quiet"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const ToolResult result = run_tool(arguments);
  EXPECT_EQ(result.status, 0) << result.errors;
  return result.output;
}

const std::vector<std::string> kFewStarts = {"--samples", "1",  "--step",   "45",
                                             "--frames",  "12", "--joints", "free"};

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
    // 12 pixels at about a metre: what no tracker can know is not judged, but told.
    if (row.at("kind") != "centre") continue;
    EXPECT_GT(number(row, "plain_translation"), 0.012);
  }
  EXPECT_THAT(summary, HasSubstr("rigid_block, severe"));
  EXPECT_THAT(
      read_text(folder / "out/mismatch_rigid_block_severe_primesense_3frames_centre_seed2.yaml"),
      HasSubstr("principal_point: ["));
}

TEST(Peers, ComparesWithTheFiguresOfTheOtherTracker) {
  const TemporaryFolder folder;
  const auto summary = run_experiment("peers", "board_door_block", folder / "out",
                                      {"--seeds", "1", "--frames", "6", "--trials", "1",
                                       "--sequence", "moving", "--fast-points", "1000"});
  const auto rows = read_rows(folder / "out/peers_board_door_block.csv");
  ASSERT_EQ(rows.size(), 2U * 6U + 3U + 2U);  // all frames twice, every second, every third
  for (const NamedRow& row : rows) {
    EXPECT_GT(number(row, "step_cpu_ms"), 0.0);
    if (row.at("every") != "1") continue;  // too fast, it may be
    EXPECT_EQ(row.at("status"), "tracking");
    EXPECT_LT(number(row, "translation"), 0.005);
    EXPECT_LT(number(row, "door"), 0.005);
  }
  EXPECT_EQ(rows[0].at("tracker"), "lockbox");
  EXPECT_EQ(rows[6].at("tracker"), "lockbox fast");
  const auto trials = read_rows(folder / "out/peers_board_door_block_capture.csv");
  ASSERT_EQ(trials.size(), 10U);  // five kinds, with and without search
  EXPECT_THAT(summary, HasSubstr("M3T best"));
  EXPECT_THAT(summary, HasSubstr("door 20 degrees"));
}

TEST(Peers, GivesThePointBudgetToTheFastSettingAlone) {
  const TemporaryFolder folder;
  const auto rows_with = [&](const std::string& points) {
    run_experiment("peers", "board_door_block", folder / points,
                   {"--seeds", "1", "--frames", "3", "--trials", "0", "--sequence", "static",
                    "--fast-points", points});
    return read_rows(folder / points / "peers_board_door_block.csv");
  };
  const auto few = rows_with("600");
  const auto more = rows_with("2000");
  ASSERT_EQ(few.size(), 6U);
  ASSERT_EQ(more.size(), 6U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(few[i].at("translation"), more[i].at("translation"));
    EXPECT_NE(few[i + 3].at("translation"), more[i + 3].at("translation"));
  }
}

TEST(Peers, RefusesAnotherSensor) {
  const TemporaryFolder folder;
  const auto result =
      run_tool({"experiment", "peers", "--output", (folder / "out").string(), "--sensor", "ideal"});
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(result.errors, HasSubstr("each sequence has its own"));
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

}  // namespace
}  // namespace lockbox
