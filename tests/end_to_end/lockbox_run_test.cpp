// SPDX-License-Identifier: BSD-3-Clause
// The shipped lockbox with all its joints moving: simulated, tracked, evaluated.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "tool.hpp"

namespace lockbox {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

TEST(Lockbox, IsTrackedWithAllItsJoints) {
  const TemporaryFolder folder;
  const auto path = [&](const char* name) { return (folder / name).string(); };
  const auto simulated =
      run_tool({"simulate", "--model", "lockbox", "--trajectory", "auto", "--frames", "300",
                "--scene", "room", "--output", path("lockbox.oni")});
  ASSERT_EQ(simulated.status, 0) << simulated.errors;
  const auto tracked = run_tool(
      {"track", "--model", "lockbox", "--source", path("lockbox.oni"), "--output", path("run")});
  ASSERT_EQ(tracked.status, 0) << tracked.errors;
  const auto evaluated = run_tool({"evaluate", "--estimate", path("run/states.csv"), "--reference",
                                   path("groundtruth.csv"), "--output", path("errors")});
  ASSERT_EQ(evaluated.status, 0) << evaluated.errors;

  const auto summary = nlohmann::json::parse(read_text(path("errors/summary.json")));
  EXPECT_LT(summary["base"]["translation"]["rmse"].get<double>(), 0.5e-3) << evaluated.output;
  EXPECT_LT(summary["base"]["rotation"]["rmse"].get<double>(), 0.05 * kDegree);
  EXPECT_EQ(summary["joints"].size(), 8U);
  const auto rmse = [&](const char* joint) {
    return summary["joints"][joint]["rmse"].get<double>();
  };
  for (const char* slider : {"cylinder_horizontal", "cylinder_vertical", "block", "slider"}) {
    EXPECT_LT(rmse(slider), 0.8e-3) << slider;
  }
  for (const char* hinge : {"door_bottom_left", "door_light_blue"}) {
    EXPECT_LT(rmse(hinge), 0.3 * kDegree) << hinge;
  }
  for (const char* handle : {"latch", "disk"}) {
    EXPECT_LT(rmse(handle), 0.6 * kDegree) << handle;
  }
}

}  // namespace
}  // namespace lockbox
