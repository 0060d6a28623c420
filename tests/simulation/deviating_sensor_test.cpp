// SPDX-License-Identifier: BSD-3-Clause
// Cameras that are not quite as calibrated, and frames that do not all arrive.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "lockbox/core/error.hpp"
#include "lockbox/simulation/delivery.hpp"
#include "lockbox/simulation/simulator.hpp"
#include "lockbox/simulation/trajectory.hpp"
#include "small_models.hpp"

namespace lockbox {
namespace {

const PinholeCamera kCalibration{320, 240, 287.9, 287.9, 159.5, 119.5};

class DeviatingSensor : public ::testing::Test {
 protected:
  /// Draws the board at that distance, facing the camera.
  void draw(const SensorDeviation& deviation, double distance = 1.31,
            const std::string& sensor = "ideal") {
    state_.configuration = rest_configuration(tree_);
    state_.configuration.T_camera_base = facing_pose(distance);
    Simulator simulator(tree_, kCalibration, PlacedScene(), sensor_model(sensor), 1, Executor(2),
                        deviation);
    simulator.simulate(state_, 0, frame_);
    apparent_ = simulator.apparent_base();
  }

  /// Where the board begins and ends in row 65, above all other parts.
  Eigen::Vector2d columns() const {
    const auto row = frame_.depth.begin() + 65 * 320;
    const auto is_measured = [](std::uint16_t depth) { return depth != 0; };
    const auto first = std::find_if(row, row + 320, is_measured);
    const auto last = std::find_if_not(first, row + 320, is_measured);
    EXPECT_NE(first, row + 320);
    return {static_cast<double>(first - row), static_cast<double>(last - row)};
  }

  KinematicTree tree_ = testing::board_with_three_joints();
  State state_;
  DepthFrame frame_;
  Eigen::Isometry3d apparent_ = Eigen::Isometry3d::Identity();
};

TEST_F(DeviatingSensor, LargerFocalLengthMakesImagesLargerUnderTheSameCalibration) {
  draw({});
  const double width = columns().y() - columns().x();
  SensorDeviation deviation;
  deviation.camera.focal_length = 1.1;
  draw(deviation);
  EXPECT_EQ(frame_.camera, kCalibration);
  EXPECT_NEAR(columns().y() - columns().x(), 1.1 * width, 1.5);
}

TEST_F(DeviatingSensor, ThePrincipalPointMovesTheImageAndWhatTheCalibrationShows) {
  draw({});
  const double first = columns().x();
  SensorDeviation deviation;
  deviation.camera.principal_point = {6.0, 0.0};
  draw(deviation);
  EXPECT_EQ(columns().x(), first + 6.0);
  const Eigen::Vector3d shift =
      apparent_.translation() - state_.configuration.T_camera_base.translation();
  EXPECT_NEAR(shift.x(), 6.0 / 287.9 * 1.28, 0.002);  // the board's and the parts' front
  EXPECT_NEAR(shift.y(), 0.0, 0.001);
}

TEST_F(DeviatingSensor, DistortionMovesPixelsAsTheBrownModelSays) {
  SensorDeviation deviation;
  deviation.camera.distortion = {0.12, -0.3};
  draw({}, 0.81);
  const Eigen::Vector2d straight = columns();
  draw(deviation, 0.81);
  const double x = 0.3 / 0.8;  // of the board's edge
  const double y = (65.0 - 119.5) / 287.9;
  const double squared = x * x + y * y;
  const double moved = x * (0.12 * squared - 0.3 * squared * squared) * 287.9;
  ASSERT_GT(std::abs(moved), 0.4);
  EXPECT_NEAR(columns().y() - straight.y(), moved, 1.0);
  // A plane that faces the camera stays one.
  EXPECT_NEAR(frame_.metres(160, 60), 0.8, 0.0011);
  EXPECT_NEAR(frame_.metres(70, 30), 0.8, 0.0011);
}

TEST_F(DeviatingSensor, DistortionThatFoldsTheImageIsRefused) {
  SensorDeviation deviation;
  deviation.camera.distortion = {-0.5, -0.5};
  EXPECT_THROW(draw(deviation), InputError);
}

TEST_F(DeviatingSensor, DepthGrowsWithTheAmounts) {
  SensorDeviation deviation;
  deviation.depth = {1.01, 0.006, 0.0};
  draw(deviation);
  EXPECT_NEAR(frame_.metres(160, 65), 1.3 * (1.01 + 0.006 * 1.3), 0.0006);
  EXPECT_GT(apparent_.translation().z() - state_.configuration.T_camera_base.translation().z(),
            0.015);
  deviation.depth = {1.0, 0.0, 0.02};
  draw(deviation);
  EXPECT_NEAR(frame_.metres(159, 119), 1.3, 0.0006);
  const double share =
      std::pow(std::hypot(159.5 - 100.0, 119.5 - 60.0) / std::hypot(159.5, 119.5), 2);
  EXPECT_NEAR(frame_.metres(100, 60), 1.3 * (1.0 + 0.02 * share), 0.0006);
}

/// Beside the board there is nothing, at an infinite depth, which no factor makes a negative one:
/// the projector's shadow would be written out of its row, which AddressSanitizer sees.
TEST_F(DeviatingSensor, DepthThatShrinksWithTheDistanceLeavesNothingWhereNothingIs) {
  SensorDeviation deviation;
  deviation.depth = {1.0, -0.006, 0.0};
  for (const char* sensor : {"ideal", "primesense", "stereo", "time-of-flight"}) {
    draw(deviation, 1.31, sensor);
    EXPECT_NEAR(frame_.metres(160, 65), 1.3 * (1.0 - 0.006 * 1.3), 0.02) << sensor;
    EXPECT_EQ(frame_.metres(2, 65), 0.0) << sensor;
  }
}

TEST_F(DeviatingSensor, WithoutADeviationTheBaseAppearsWhereItIs) {
  draw({});
  EXPECT_EQ(apparent_.matrix(), state_.configuration.T_camera_base.matrix());
}

std::vector<State> run_of(std::size_t frames) {
  return generate_trajectory(testing::board_with_three_joints(),
                             {.frames = static_cast<int>(frames)});
}

TEST(DeliveredFrames, AreAllOfThemWithoutADeviation) {
  const auto run = run_of(20);
  const auto frames = delivered_frames(run, {}, 1);
  ASSERT_EQ(frames.size(), run.size());
  for (std::size_t i = 0; i < run.size(); ++i) {
    EXPECT_EQ(frames[i].state.stamp, run[i].stamp);
    EXPECT_FALSE(frames[i].is_repeated);
  }
}

TEST(DeliveredFrames, HalfTheRateIsEverySecondOne) {
  const auto run = run_of(20);
  const auto frames = delivered_frames(run, {15.0, 0.0, 0.0}, 1);
  ASSERT_EQ(frames.size(), 10U);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(frames[i].state.stamp, run[2 * i].stamp);
  }
}

TEST(DeliveredFrames, RepeatedOnesShowWhatTheFrameBeforeShowed) {
  const auto frames = delivered_frames(run_of(400), {0.0, 0.1, 0.2}, 3);
  int repeated = 0;
  for (std::size_t i = 1; i < frames.size(); ++i) {
    EXPECT_GT(frames[i].state.stamp, frames[i - 1].state.stamp);
    if (!frames[i].is_repeated) continue;
    ++repeated;
    EXPECT_EQ(frames[i].state.configuration.q, frames[i - 1].state.configuration.q);
  }
  EXPECT_FALSE(frames.front().is_repeated);
  EXPECT_NEAR(static_cast<double>(frames.size()), 320.0, 30.0);
  EXPECT_NEAR(repeated, 32, 16);
}

TEST(DeliveredFrames, FollowFromTheSeed) {
  const auto run = run_of(100);
  const auto stamps = [&](std::uint64_t seed) {
    std::vector<double> result;
    for (const auto& frame : delivered_frames(run, {0.0, 0.0, 0.5}, seed)) {
      result.push_back(frame.state.stamp);
    }
    return result;
  };
  EXPECT_EQ(stamps(1), stamps(1));
  EXPECT_NE(stamps(1), stamps(2));
}

}  // namespace
}  // namespace lockbox
