// SPDX-License-Identifier: BSD-3-Clause
// How runs end, and what they say then.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <thread>

#include "block_runs.hpp"

namespace lockbox {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;

class RunEnds : public BlockRuns {};

TEST_F(RunEnds, WithTheStatusOfTheSignalAndCompleteFiles) {
  const std::vector<std::pair<int, std::string>> signals = {
      {SIGHUP, "SIGHUP"}, {SIGINT, "SIGINT"}, {SIGTERM, "SIGTERM"}};
  for (const auto& [signal, name] : signals) {
    Tool tool(following(name, {"--realtime"}));
    wait_for_rows(name, 3);
    tool.send_signal(signal);
    const auto result = tool.wait();
    EXPECT_EQ(result.status, 128 + signal) << result.errors;
    const auto text = read_text(path(name + "/states.csv"));
    EXPECT_EQ(text.back(), '\n');
    const auto rows = read_lines(path(name + "/states.csv")).size() - 1;
    EXPECT_LT(rows, kFrames) << "it was not interrupted";
    const auto description = read_text(path(name + "/run.yaml"));
    EXPECT_THAT(description, HasSubstr("end: signal " + name));
    EXPECT_THAT(description, HasSubstr("total: " + std::to_string(rows)));
  }
}

TEST_F(RunEnds, WithinASecondWhereTheObjectIsSought) {
  // Another model than the recording shows is sought for a long time.
  auto arguments = tracking("block", "searching");
  arguments[2] = "cabinet";
  Tool tool(arguments);
  while (read_lines(path("searching/states.csv")).empty()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  const auto signalled = std::chrono::steady_clock::now();
  tool.send_signal(SIGTERM);
  const auto result = tool.wait();
  EXPECT_EQ(result.status, 128 + SIGTERM);
  EXPECT_LT(std::chrono::steady_clock::now() - signalled, std::chrono::seconds(2));
  const auto description = read_text(path("searching/run.yaml"));
  EXPECT_THAT(description, HasSubstr("end: signal SIGTERM"));
  EXPECT_THAT(result.output, HasSubstr("0 frames\nno results"));
  EXPECT_THAT(result.output + description, Not(HasSubstr("latency"))) << "none was measured";
  const auto again = run_tool(following("searching", {"--max-frames", "1"}));
  EXPECT_EQ(again.status, 0) << again.errors;
  EXPECT_THAT(again.errors, HasSubstr("before its first row; it is replaced"));
  EXPECT_EQ(run_tool(following("searching", {"--max-frames", "1"})).status, 3) << "it has a row";
}

TEST_F(RunEnds, AreAwaitedWithALineWithinASecondWhereNobodySeesATerminal) {
  auto arguments = tracking("block", "told");
  arguments[2] = "cabinet";
  Tool tool(arguments);
  while (read_lines(path("told/states.csv")).empty()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(1200));
  tool.send_signal(SIGKILL);
  // Of the first frame, or of the next one if its search took less.
  EXPECT_THAT(tool.wait().errors,
              testing::ContainsRegex("[0-9]/30 frames, searching for the object: [01] s"));
}

TEST_F(RunEnds, WithTheStatusOfTheSignalAndNothingWrittenWhereAModelIsBeingLoaded) {
  // Its field takes seconds to build.
  write_text(path("fine.urdf"),
             "<robot name=\"r\"><link name=\"base\"><visual><geometry><box size=\"0.3 0.3 0.3\"/>"
             "</geometry></visual></link></robot>");
  write_text(path("fine.yaml"), "voxel: 0.0005\n");
  for (const int signal : {SIGHUP, SIGINT, SIGTERM}) {
    auto arguments = tracking("block", "unloaded");
    arguments[2] = path("fine.urdf");
    Tool tool(arguments, {"XDG_CACHE_HOME=" + path("cache")});
    tool.wait_for_handler(signal);
    const auto signalled = std::chrono::steady_clock::now();
    tool.send_signal(signal);
    const auto result = tool.wait();
    EXPECT_EQ(result.status, 128 + signal);
    EXPECT_LT(std::chrono::steady_clock::now() - signalled, std::chrono::seconds(1));
    EXPECT_THAT(result.errors, ContainsRegex("ended by SIG[A-Z]+\n$"));
    EXPECT_FALSE(std::filesystem::exists(path("unloaded")));
    EXPECT_FALSE(std::filesystem::exists(path("cache/lockbox")));
  }
}

TEST_F(RunEnds, WithinASecondInAPauseOfAnHour) {
  std::filesystem::copy(path("block"), path("gap"), std::filesystem::copy_options::recursive);
  write_text(path("gap/depth.txt"), "0 depth/000000.png\n3600 depth/000001.png\n");
  Tool tool(tracking("gap", "in_gap", {"--realtime", "--initial-state", start_}));
  wait_for_rows("in_gap", 1);
  const auto signalled = std::chrono::steady_clock::now();
  tool.send_signal(SIGINT);
  EXPECT_EQ(tool.wait().status, 128 + SIGINT);
  EXPECT_LT(std::chrono::steady_clock::now() - signalled, std::chrono::seconds(2));
}

TEST_F(RunEnds, WithTheStatusOfAPipeThatWasClosed) {
  const auto pipe = path("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  Tool tool(following("piped"), {}, pipe);
  close(reader);
  EXPECT_EQ(tool.wait().status, 128 + SIGPIPE);
  EXPECT_THAT(read_lines(path("piped/states.csv")), SizeIs(kFrames + 1));
  EXPECT_THAT(read_text(path("piped/run.yaml")), HasSubstr("total: 30"));
}

TEST_F(RunEnds, OfASimulationIsACompleteFolder) {
  Tool tool({"simulate", "--model", "rigid_block", "--trajectory", "auto", "--frames", "3000",
             "--output", path("cut_short")});
  while (read_lines(path("cut_short/depth.txt")).size() < 3) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  tool.send_signal(SIGTERM);
  EXPECT_EQ(tool.wait().status, 128 + SIGTERM);
  EXPECT_EQ(read_lines(path("cut_short/depth.txt")).size(),
            read_lines(path("cut_short/groundtruth.csv")).size());
}

TEST_F(RunEnds, OfASimulationComesAfterTheFramesThatWereAskedFor) {
  const auto result = run_tool({"simulate", "--model", "rigid_block", "--trajectory", start_,
                                "--frames", "3", "--output", path("three")});
  ASSERT_EQ(result.status, 0) << result.errors;
  EXPECT_THAT(read_lines(path("three/depth.txt")), SizeIs(4));
  EXPECT_THAT(read_lines(path("three/groundtruth.csv")), SizeIs(4));
}

TEST_F(RunEnds, AsFailedWhereTheObjectIsNeverTrackedAndSayWhatTheDepthsTell) {
  write_text(path("aside.csv"),
             "timestamp,tx,ty,tz,qx,qy,qz,qw\n0,4,0,0.9,1,0,0,0\n0.1,4,0,0.9,1,0,0,0\n");
  ASSERT_EQ(simulate(path("aside.csv"), "empty").status, 0);
  const auto result = run_tool(tracking("empty", "nothing"));
  EXPECT_EQ(result.status, 5);
  EXPECT_THAT(result.errors, HasSubstr("not found up to frame 0"));
  EXPECT_THAT(result.errors, testing::ContainsRegex("not found in any of 2 frames:\n.*depth"));
  const auto quiet = run_tool(tracking("empty", "quiet", {"--quiet", "--max-frames", "1"}));
  EXPECT_EQ(quiet.status, 5);
  EXPECT_THAT(quiet.errors, HasSubstr("not found in the only frame:\n"));
  EXPECT_THAT(quiet.errors, Not(HasSubstr("up to")));
}

TEST_F(RunEnds, WithWhatWasLostAndNotFoundAgain) {
  ASSERT_EQ(simulate(start_, "dark").status, 0);
  write_text(path("dark/depth.txt"),
             "0 depth/000000.png\n0.033 depth/none.png\n0.066 depth/none.png\n");
  const auto result = run_tool(tracking("dark", "lost"));
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.errors, HasSubstr("the object was lost, and not found again up to frame"));
  EXPECT_THAT(result.errors, Not(HasSubstr("was not found")));
}

TEST_F(RunEnds, WithADoubtAboutADepthScaleThatPutsEverythingOutOfRange) {
  ASSERT_EQ(simulate(start_, "room", {"--scene", "room"}).status, 0);
  for (const std::string scale : {"100", "100000"}) {
    const auto result =
        run_tool(tracking("room", "scale" + scale, {"--depth-scale", scale, "--max-frames", "2"}));
    EXPECT_EQ(result.status, 5);
    EXPECT_THAT(result.errors, HasSubstr("--depth-scale"));
  }
}

TEST_F(RunEnds, WithADescriptionOfHowItWasStarted) {
  const auto result = run_tool(following("described", {"--max-frames", "1"}));
  ASSERT_EQ(result.status, 0) << result.errors;
  EXPECT_THAT(result.output, HasSubstr("1 frame, 1 tracking"));
  const auto description = read_text(path("described/run.yaml"));
  EXPECT_THAT(description, ContainsRegex("command: .*lockbox track --model rigid_block "));
  EXPECT_THAT(description, ContainsRegex("started: 20[0-9-]+T[0-9:]+[+-][0-9][0-9]:[0-9][0-9]\n"));
  EXPECT_THAT(description, ContainsRegex("host: ."));
  EXPECT_THAT(description, ContainsRegex("folder: /"));
  EXPECT_THAT(description, HasSubstr("end: frame limit reached"));
}

TEST_F(RunEnds, WithTheErrorInItsDescription) {
  std::filesystem::create_directory(path("failed"));
  ASSERT_EQ(symlink("/dev/full", path("failed/base.tum").c_str()), 0);
  const auto result = run_tool(following("failed"));
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(read_text(path("failed/run.yaml")), ContainsRegex("end: .?error: .*base.tum"));
}

TEST_F(RunEnds, AreAwaitedWithALineThatMovesOnATerminal) {
  std::filesystem::copy(path("block"), path("slow"), std::filesystem::copy_options::recursive);
  write_text(path("slow/depth.txt"), "0 depth/000000.png\n1.4 depth/000001.png\n");
  std::string command = "TERM=xterm script -qec '" LOCKBOX_TOOL;
  for (const auto& argument :
       tracking("slow", "awaited", {"--realtime", "--initial-state", start_})) {
    command += " " + argument;
  }
  FILE* const terminal = popen((command + "' /dev/null 2>&1 </dev/null").c_str(), "r");
  ASSERT_NE(terminal, nullptr);
  std::string shown;
  for (int c = fgetc(terminal); c != EOF; c = fgetc(terminal)) shown += static_cast<char>(c);
  EXPECT_EQ(pclose(terminal), 0) << shown;
  EXPECT_THAT(shown, HasSubstr("waiting for a frame: 1 s"));
}

}  // namespace
}  // namespace lockbox
