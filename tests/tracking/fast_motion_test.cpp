// SPDX-License-Identifier: BSD-3-Clause
// Steps that the iterations of a frame do not reach the end of.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "initialization/seen_model.hpp"
#include "lockbox/simulation/trajectory.hpp"
#include "lockbox/tracking/tracker.hpp"

namespace lockbox {
namespace {

/// The board with its door closed, tilted before the camera; that far along its own x axis.
Configuration board_at(const ArticulatedModel& model, double x) {
  Configuration configuration = rest_configuration(model.tree);
  configuration.T_camera_base = facing_pose(1.2) *
                                Eigen::AngleAxisd(0.2, Eigen::Vector3d(0.6, 0.8, 0.0)) *
                                Eigen::Translation3d(x, 0.0, 0.0);
  return configuration;
}

/// Hardly anything contradicts a board that is a few centimetres off within its own plane: the
/// first iterations must not be believed, for they have not reached the end of the step.
TEST(FastMotion, AStepWithinThePlaneIsFollowedToItsEnd) {
  const ArticulatedModel& model = shipped("board_door_block");
  Tracker tracker(model, {});
  tracker.start(board_at(model, 0.0));
  tracker.process(seen_frame(model, board_at(model, 0.0), wall_behind(1.0)));
  const Configuration truth = board_at(model, 0.03);
  DepthFrame frame = seen_frame(model, truth, wall_behind(1.0));
  frame.stamp += 1.0 / 30.0;
  const TrackingResult& result = tracker.process(frame);
  EXPECT_EQ(result.status, TrackingStatus::tracking);
  const Eigen::Isometry3d error =
      truth.T_camera_base.inverse() * result.configuration.T_camera_base;
  EXPECT_LT(error.translation().norm(), 0.002);
}

/// So little of the block is within its gate on the way that its last step is no more than noise.
TEST(FastMotion, WhatLeapsFartherThanItsGateIsFollowedToItsEnd) {
  const ArticulatedModel& model = shipped("board_door_block");
  const Configuration before = board_at(model, 0.0);
  Tracker tracker(model, {});
  tracker.start(before);
  tracker.process(seen_frame(model, before, wall_behind(1.0)));
  Configuration truth = before;
  truth.T_camera_base = before.T_camera_base * Eigen::Translation3d(0.075, 0.0, 0.02) *
                        Eigen::AngleAxisd(0.09, Eigen::Vector3d(0.5, 0.5, 0.7).normalized());
  truth.q[1] += 0.03;
  DepthFrame frame = seen_frame(model, truth, wall_behind(1.0));
  frame.stamp += 1.0 / 30.0;
  const TrackingResult& result = tracker.process(frame);
  EXPECT_EQ(result.status, TrackingStatus::tracking);
  EXPECT_NEAR(result.configuration.q[1], truth.q[1], 0.002);  // 34 mm off at the first rest
}

/// A door of the lockbox turns edge-on with its latch on it, so fast that the latch is contradicted
/// before the iterations of the frame are through: it must not be taken for one that leapt.
TEST(FastMotion, APartThatIsStillOnItsWayIsNotSoughtElsewhere) {
  const ArticulatedModel& model = shipped("lockbox");
  TrajectoryOptions options;
  options.frames = 40;
  const std::vector<State> run = generate_trajectory(model.tree, options);
  const auto joint = std::find_if(model.tree.joints.begin(), model.tree.joints.end(),
                                  [](const Joint& j) { return j.name == "latch"; });
  const int latch = joint->variable;
  Tracker tracker(model, {});
  tracker.start(run[17].configuration);
  for (std::size_t k = 17; k < 23; ++k) {
    DepthFrame frame = seen_frame(model, run[k].configuration, wall_behind(0.6));
    frame.stamp = run[k].stamp;
    const TrackingResult& result = tracker.process(frame);
    EXPECT_NEAR(result.configuration.q[latch], run[k].configuration.q[latch], 0.1) << "frame " << k;
  }
}

}  // namespace
}  // namespace lockbox
