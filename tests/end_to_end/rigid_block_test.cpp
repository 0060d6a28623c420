// SPDX-License-Identifier: BSD-3-Clause
// A rigid block, simulated into a genuine recording, tracked, evaluated.
#include <gmock/gmock.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <memory>
#include <thread>

#include "camera_file.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/model/states_file.hpp"
#include "tool.hpp"

namespace lockbox {
namespace {

using testing::HasSubstr;
using testing::SizeIs;

constexpr std::size_t kFrames = 30;

class RigidBlock : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    write_camera_file(path("camera.yaml"), 320);
    simulated_ = simulate("auto", "block.oni");
  }
  static void TearDownTestSuite() { folder_.reset(); }

  void SetUp() override { ASSERT_EQ(simulated_.status, 0) << simulated_.errors; }

  static std::string path(const std::string& name) { return (*folder_ / name).string(); }

  static ToolResult simulate(const std::string& trajectory, const std::string& output) {
    return run_tool({"simulate", "--model", "rigid_block", "--trajectory", trajectory, "--frames",
                     std::to_string(kFrames), "--camera-info", path("camera.yaml"), "--output",
                     path(output)});
  }

  static ToolResult track(const std::string& source, const std::string& run,
                          std::vector<std::string> more = {},
                          const std::vector<std::string>& environment = {}) {
    more.insert(more.begin(),
                {"track", "--model", "rigid_block", "--source", source, "--output", path(run)});
    return run_tool(more, environment);
  }

  static std::unique_ptr<TemporaryFolder> folder_;
  static ToolResult simulated_;
};

std::unique_ptr<TemporaryFolder> RigidBlock::folder_;
ToolResult RigidBlock::simulated_;

TEST_F(RigidBlock, IsTrackedThroughAGenuineRecording) {
  const auto tracked = track(path("block.oni"), "run");
  ASSERT_EQ(tracked.status, 0) << tracked.errors;
  EXPECT_THAT(tracked.output, HasSubstr("30 frames"));
  EXPECT_THAT(read_lines(path("run/base.tum")), SizeIs(kFrames));
  const std::string description = read_text(path("run/run.yaml"));
  for (const auto* key : {"model:", "source:", "fx: 288", "iterations: 3", "noise_correlation:",
                          "lockbox: ", "end: end of the source", "total: 30", "p95:"}) {
    EXPECT_THAT(description, HasSubstr(key));
  }

  const auto evaluated = run_tool({"evaluate", "--estimate", path("run/states.csv"), "--reference",
                                   path("groundtruth.csv"), "--output", path("errors")});
  ASSERT_EQ(evaluated.status, 0) << evaluated.errors;
  EXPECT_THAT(evaluated.output, HasSubstr("base translation"));
  EXPECT_THAT(read_text(path("errors/summary.json")), HasSubstr("translation"));

  const KinematicTree tree = load_kinematic_tree(LOCKBOX_MODELS "/rigid_block/rigid_block.urdf");
  const auto estimate = read_states(path("run/states.csv"), tree).states;
  const auto truth = read_states(path("groundtruth.csv"), tree).states;
  ASSERT_THAT(estimate, SizeIs(kFrames));
  for (std::size_t i = 0; i < kFrames; ++i) {
    EXPECT_NEAR(estimate[i].stamp, truth[i].stamp, 1e-6);
    EXPECT_EQ(estimate[i].status, "tracking") << "frame " << i;
    const auto T_true_estimated =
        truth[i].configuration.T_camera_base.inverse() * estimate[i].configuration.T_camera_base;
    EXPECT_LT(T_true_estimated.translation().norm(), 0.003) << "frame " << i;
    EXPECT_LT(Eigen::AngleAxisd(T_true_estimated.linear()).angle(), 0.01) << "frame " << i;
  }
}

TEST_F(RigidBlock, ComesOutTheSameFromARecordingAndAFolderOnAnyNumberOfThreads) {
  // The truth carries the recording's stamps, which are whole microseconds.
  ASSERT_EQ(simulate(path("groundtruth.csv"), "images").status, 0);
  ASSERT_EQ(track(path("images"), "from_folder", {"--threads", "1"}).status, 0);
  ASSERT_EQ(track(path("block.oni"), "from_recording", {"--threads", "3"}).status, 0);
  const auto rows = rows_without_latency(path("from_folder/states.csv"));
  ASSERT_THAT(rows, SizeIs(kFrames + 1));
  EXPECT_EQ(rows, rows_without_latency(path("from_recording/states.csv")));
}

TEST_F(RigidBlock, LeavesCompleteFilesAfterAnInterruption) {
  Tool tool({"track", "--model", "rigid_block", "--source", path("block.oni"), "--realtime",
             "--initial-state", path("groundtruth.csv"), "--output", path("interrupted")});
  const auto states = path("interrupted/states.csv");
  for (int waits = 0; waits < 2000 && read_lines(states).size() < 5; ++waits) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  tool.send_signal(SIGINT);
  const auto result = tool.wait();
  EXPECT_EQ(result.status, 130) << result.errors;

  const std::string text = read_text(states);
  EXPECT_EQ(text.back(), '\n');
  const auto rows = read_lines(states);
  EXPECT_LT(rows.size(), kFrames + 1) << "it was not interrupted";
  const std::string total = "total: " + std::to_string(rows.size() - 1);
  EXPECT_THAT(read_text(path("interrupted/run.yaml")), HasSubstr(total));
  EXPECT_THAT(read_text(path("interrupted/run.yaml")), HasSubstr("end: signal SIGINT"));
}

TEST_F(RigidBlock, StopsAtTheFrameLimitAndDrawsSnapshots) {
  const auto result = track(path("block.oni"), "limited",
                            {"--max-frames", "4", "--snapshots", path("snapshots"),
                             "--snapshot-interval", "2", "--covariance", "--quiet"});
  ASSERT_EQ(result.status, 0) << result.errors;
  EXPECT_EQ(result.output + result.errors, "");
  EXPECT_THAT(read_lines(path("limited/states.csv")), SizeIs(1 + 4));
  EXPECT_TRUE(std::filesystem::exists(path("snapshots/frame_000002.png")));
  EXPECT_FALSE(std::filesystem::exists(path("snapshots/frame_000001.png")));
  const auto covariance = read_lines(path("limited/covariance.csv"));
  ASSERT_THAT(covariance, SizeIs(2 + 1 + 4));
  EXPECT_EQ(std::count(covariance.back().begin(), covariance.back().end(), ','), 36);
}

TEST_F(RigidBlock, WritesNumbersInTheCLocaleWhateverTheUsersIs) {
  const std::string define = "localedef -i de_DE -f UTF-8 " + path("de_DE.UTF-8");
  if (std::system((define + " >/dev/null 2>&1").c_str()) != 0) {
    GTEST_SKIP() << "no German locale can be made here";
  }
  const std::vector<std::string> german = {"LOCPATH=" + path(""), "LC_ALL=de_DE.UTF-8"};
  const std::vector<std::string> limit = {"--max-frames", "2"};
  ASSERT_EQ(track(path("block.oni"), "german", limit, german).status, 0);
  ASSERT_EQ(track(path("block.oni"), "plain", limit, {"LC_ALL=C"}).status, 0);
  EXPECT_EQ(rows_without_latency(path("german/states.csv")),
            rows_without_latency(path("plain/states.csv")));
  EXPECT_THAT(read_text(path("german/run.yaml")), HasSubstr("fx: 288,"));
}

TEST_F(RigidBlock, IsFoundWhereItIsFromAStartThatIsWrong) {
  write_text(path("elsewhere.csv"), "timestamp,tx,ty,tz,qx,qy,qz,qw\n0,0.3,-0.25,0.7,1,0,0,0\n");
  const auto result = track(path("block.oni"), "found", {"--initial-state", path("elsewhere.csv")});
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_THAT(read_lines(path("found/states.csv")).back(), HasSubstr(",tracking,"));
}

TEST_F(RigidBlock, IsReportedLostWhenItIsNotThereAnyMore) {
  write_text(path("leaving.csv"),
             "timestamp,tx,ty,tz,qx,qy,qz,qw\n0,0,0,0.9,1,0,0,0\n0.033,0,0,0.9,1,0,0,0\n"
             "0.066,4,0,0.9,1,0,0,0\n0.1,4,0,0.9,1,0,0,0\n");
  ASSERT_EQ(simulate(path("leaving.csv"), "leaving").status, 0);
  const auto result =
      track(path("leaving"), "lost", {"--initial-state", path("leaving.csv"), "--covariance"});
  EXPECT_EQ(result.status, 1) << result.errors;
  EXPECT_THAT(read_lines(path("lost/states.csv")).back(),
              HasSubstr(",nan,nan,nan,nan,nan,nan,nan,lost,"));
  EXPECT_THAT(read_lines(path("lost/base.tum")), SizeIs(2));
  const std::string covariance = read_lines(path("lost/covariance.csv")).back();
  EXPECT_EQ(std::count(covariance.begin(), covariance.end(), ','), 36);
}

TEST_F(RigidBlock, RowsWithoutAnEstimateAreEvaluatedToo) {
  write_text(path("away.csv"), "timestamp,tx,ty,tz,qx,qy,qz,qw\n0,4,0,0.9,1,0,0,0\n");
  ASSERT_EQ(simulate(path("away.csv"), "away").status, 0);
  ASSERT_EQ(track(path("away"), "unknown").status, 5);
  ASSERT_THAT(read_lines(path("unknown/states.csv")).back(),
              HasSubstr(",nan,initializing,nan,nan,nan,"));
  const auto evaluated = run_tool({"evaluate", "--model", "rigid_block", "--estimate",
                                   path("unknown/states.csv"), "--reference", path("away.csv")});
  EXPECT_EQ(evaluated.status, 0) << evaluated.errors;
}

}  // namespace
}  // namespace lockbox
