// SPDX-License-Identifier: BSD-3-Clause
// A run of the tool for those who look at it.
#pragma once

#include <gmock/gmock.h>

#include <memory>

#include "../visualization/x_user.hpp"
#include "tool.hpp"

namespace lockbox {

inline constexpr std::size_t kFrames = 30;

class View : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    user_ = std::make_unique<XUser>();
    simulated_ = run_tool({"simulate", "--model", "rigid_block", "--trajectory", "auto", "--frames",
                           std::to_string(kFrames), "--output", path("block.oni")});
    tracked_ = track("run");
  }
  static void TearDownTestSuite() {
    user_.reset();
    folder_.reset();
  }

  void SetUp() override {
    if (!user_->is_connected()) GTEST_SKIP() << "no display";
    ASSERT_EQ(simulated_.status, 0) << simulated_.errors;
    ASSERT_EQ(tracked_.status, 0) << tracked_.errors;
  }

  static std::string path(const std::string& name) { return (*folder_ / name).string(); }

  static std::vector<std::string> tracking(const std::string& run,
                                           const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {
        "track",           "--model",         "rigid_block",           "--source",
        path("block.oni"), "--initial-state", path("groundtruth.csv"), "--output",
        path(run)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  static ToolResult track(const std::string& run, const std::vector<std::string>& more = {},
                          const std::vector<std::string>& environment = {}) {
    return run_tool(tracking(run, more), environment);
  }

  static std::vector<std::string> viewing(const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"view",
                                          "--model",
                                          "rigid_block",
                                          "--source",
                                          path("block.oni"),
                                          "--states",
                                          path("run/states.csv")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  inline static std::unique_ptr<TemporaryFolder> folder_;
  inline static std::unique_ptr<XUser> user_;
  inline static ToolResult simulated_;
  inline static ToolResult tracked_;
};

}  // namespace lockbox
