// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "camera_file.hpp"
#include "tool.hpp"

namespace lockbox {

inline constexpr std::size_t kFrames = 30;

/// Runs on a recording of a rigid block, which the tests of one program share.
class BlockRuns : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    write_camera_file(path("camera.yaml"), 160);
    simulated_ = simulate("auto", "block");
    start_ = path("block/groundtruth.csv");
  }
  static void TearDownTestSuite() { folder_.reset(); }

  void SetUp() override { ASSERT_EQ(simulated_.status, 0) << simulated_.errors; }

  static std::string path(const std::string& name) { return (*folder_ / name).string(); }

  static ToolResult simulate(const std::string& trajectory, const std::string& output,
                             const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {
        "simulate", "--model",       "rigid_block",       "--trajectory", trajectory,  "--frames",
        "30",       "--camera-info", path("camera.yaml"), "--output",     path(output)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_tool(arguments);
  }

  static std::vector<std::string> tracking(const std::string& source, const std::string& run,
                                           const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"track",      "--model",  "rigid_block", "--source",
                                          path(source), "--output", path(run)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  /// Begins where it is, so that no time goes into a search.
  static std::vector<std::string> following(const std::string& run,
                                            const std::vector<std::string>& more = {}) {
    auto arguments = tracking("block", run, {"--initial-state", start_});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  static void wait_for_rows(const std::string& run, std::size_t rows) {
    for (int waits = 0; waits < 2000 && read_lines(path(run + "/states.csv")).size() < rows + 1;
         ++waits) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }

  static inline std::unique_ptr<TemporaryFolder> folder_;
  static inline ToolResult simulated_;
  static inline std::string start_;
};

}  // namespace lockbox
