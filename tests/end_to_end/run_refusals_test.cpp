// SPDX-License-Identifier: BSD-3-Clause
// Runs that end before they begin, and what they leave alone.
#include <gmock/gmock.h>
#include <signal.h>

#include "block_runs.hpp"
#include "lockbox/capture/oni_validator.hpp"
#include "lockbox/capture/oni_writer.hpp"

namespace lockbox {
namespace {

using testing::HasSubstr;
using testing::SizeIs;

class RunIsRefused : public BlockRuns {};

TEST_F(RunIsRefused, WhereAnotherWritesIntoTheFolder) {
  std::filesystem::copy(path("block"), path("paused"), std::filesystem::copy_options::recursive);
  write_text(path("paused/depth.txt"),
             "0 depth/000000.png\n0.1 depth/000001.png\n3600 depth/000002.png\n");
  Tool first(tracking("paused", "shared", {"--realtime", "--initial-state", start_}));
  wait_for_rows("shared", 2);
  for (const bool overwrites : {false, true}) {
    auto arguments = following("shared");
    if (overwrites) arguments.emplace_back("--overwrite");
    const auto second = run_tool(arguments);
    EXPECT_EQ(second.status, 3);
    EXPECT_THAT(second.errors, HasSubstr(path("shared") + ": another run"));
  }
  EXPECT_THAT(read_lines(path("shared/states.csv")), SizeIs(3));
  first.send_signal(SIGKILL);
  EXPECT_EQ(first.wait().status, -SIGKILL);
  const auto after_crash = run_tool(following("shared", {"--overwrite"}));
  EXPECT_EQ(after_crash.status, 0) << after_crash.errors;
}

TEST_F(RunIsRefused, WhereAnotherRecordsIntoTheFile) {
  const std::string file = path("recorded.oni");
  const PinholeCamera camera{160, 120, 144.0, 144.0, 79.5, 59.5};
  OniWriter first(file, camera, 30);
  first.write({.camera = camera, .depth = std::vector<std::uint16_t>(160 * 120, 1000)});
  const auto record = [&] {
    return run_tool({"record", "--source", path("block"), "--output", file, "--overwrite"});
  };
  const auto recorded = record();
  EXPECT_EQ(recorded.status, 3);
  EXPECT_THAT(recorded.errors, HasSubstr(file + ": another run is recording"));
  const auto simulated = simulate(start_, "recorded.oni", {"--overwrite"});
  EXPECT_EQ(simulated.status, 3);
  EXPECT_THAT(simulated.errors, HasSubstr(file + ": another run is recording"));
  EXPECT_FALSE(std::filesystem::exists(path("groundtruth.csv")));
  first.finish();
  EXPECT_EQ(validate_oni(file).frame_count, 1U);
}

TEST_F(RunIsRefused, WhereAnEarlierOneWouldBeOverwrittenUnasked) {
  ASSERT_EQ(run_tool(following("twice", {"--covariance"})).status, 0);
  const auto before = read_text(path("twice/states.csv"));
  const auto refused = run_tool(following("twice", {"--max-frames", "2"}));
  EXPECT_EQ(refused.status, 3);
  EXPECT_THAT(refused.errors, HasSubstr("twice/states.csv"));
  EXPECT_THAT(refused.errors, HasSubstr("--overwrite"));
  EXPECT_EQ(read_text(path("twice/states.csv")), before);
  const auto asked = run_tool(following("twice", {"--max-frames", "2", "--overwrite"}));
  EXPECT_EQ(asked.status, 0) << asked.errors;
  EXPECT_THAT(read_lines(path("twice/states.csv")), SizeIs(3));
  EXPECT_FALSE(std::filesystem::exists(path("twice/covariance.csv"))) << "of the earlier run";
}

TEST_F(RunIsRefused, WhereARecordingWouldBeOverwrittenUnasked) {
  ASSERT_EQ(simulate(start_, "new/block.oni").status, 0);
  const auto before = read_text(path("new/block.oni"));
  EXPECT_EQ(simulate(start_, "new/block.oni").status, 3);
  const auto other = simulate(start_, "new/other.oni");
  EXPECT_EQ(other.status, 3);
  EXPECT_THAT(other.errors, HasSubstr("groundtruth.csv")) << "it is that of the other recording";
  EXPECT_THAT(other.errors, HasSubstr("--output " + path("new/other_recording/other.oni")));
  EXPECT_EQ(run_tool(following("recorded", {"--record", path("new/block.oni")})).status, 3);
  EXPECT_EQ(run_tool({"record", "--source", "openni2:", "--output", path("new/block.oni")}).status,
            3);
  EXPECT_EQ(read_text(path("new/block.oni")), before);
  EXPECT_EQ(simulate(start_, "block").status, 3);
  EXPECT_EQ(simulate(start_, "new/block.oni", {"--overwrite", "--seed", "2"}).status, 0);
  EXPECT_NE(read_text(path("new/block.oni")), before);
  ASSERT_EQ(simulate(start_, "images").status, 0);
  EXPECT_EQ(simulate(start_, "images", {"--overwrite"}).status, 0);
  EXPECT_THAT(read_lines(path("images/depth.txt")), SizeIs(kFrames + 1));
}

TEST_F(RunIsRefused, WhereTemporaryFilesHaveNoFolder) {
  ASSERT_EQ(simulate(start_, "temporary/block.oni").status, 0);
  const auto result =
      run_tool(tracking("temporary/block.oni", "temporary/run"), {"TMPDIR=" + path("gone")});
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(result.errors, HasSubstr("TMPDIR"));
  EXPECT_THAT(result.errors, HasSubstr(path("gone")));
  const auto recorded =
      run_tool({"record", "--source", path("block"), "--output", path("temporary/again.oni")},
               {"TMPDIR=" + path("gone")});
  EXPECT_EQ(recorded.status, 3);
  EXPECT_THAT(recorded.errors, HasSubstr("TMPDIR"));
  EXPECT_FALSE(std::filesystem::exists(path("temporary/again.oni")));
}

}  // namespace
}  // namespace lockbox
