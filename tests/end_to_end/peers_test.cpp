// SPDX-License-Identifier: BSD-3-Clause
// The smallest version of the experiment that compares with another tracker.
#include <gmock/gmock.h>

#include "small_experiment.hpp"
#include "tool.hpp"

namespace lockbox {
namespace {

using testing::HasSubstr;

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
  EXPECT_THAT(summary, HasSubstr("M3T best       0.29 / 2.10 / 2.50    0.05 / - / 0.30  "));
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

}  // namespace
}  // namespace lockbox
