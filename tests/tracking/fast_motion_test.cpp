// SPDX-License-Identifier: BSD-3-Clause
// Steps that the iterations of a frame do not reach the end of.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

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

int variable_of(const ArticulatedModel& model, const std::string& joint) {
  return model.tree.joints[static_cast<std::size_t>(joint_index(model.tree, joint))].variable;
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

/// All of it leaps, and its parts move, too: once the base is found, the block is on its way still.
TEST(FastMotion, AfterALeapPartsAreFollowedToTheirEnd) {
  const ArticulatedModel& model = shipped("board_door_block");
  Configuration before = board_at(model, 0.0);
  before.T_camera_base = facing_pose(1.2) * Eigen::AngleAxisd(0.27, Eigen::Vector3d::UnitX()) *
                         Eigen::AngleAxisd(0.17, Eigen::Vector3d::UnitY());
  Tracker tracker(model, {});
  tracker.start(before);
  tracker.process(seen_frame(model, before, wall_behind(1.0)));
  Configuration truth = before;
  truth.T_camera_base = before.T_camera_base * Eigen::Translation3d(0.036, -0.025, -0.0175) *
                        Eigen::AngleAxisd(0.065, Eigen::Vector3d(0.53, -0.81, -0.26).normalized());
  truth.q += Eigen::Vector2d(0.106, 0.020);
  DepthFrame frame = seen_frame(model, truth, wall_behind(1.0));
  frame.stamp += 1.0 / 30.0;
  const TrackingResult& result = tracker.process(frame);
  EXPECT_EQ(result.status, TrackingStatus::tracking);
  EXPECT_NEAR(result.configuration.q[1], truth.q[1], 0.002);
}

/// The slider stands out so little that it is explained in wrong places, too: one that was dragged
/// there while the board was on its way must not be believed.
TEST(FastMotion, PartsStayWhereTheyWereOnABaseThatLeaps) {
  const ArticulatedModel& model = shipped("lockbox");
  Configuration before = rest_configuration(model.tree);
  before.T_camera_base = facing_pose(1.3);
  Tracker tracker(model, {});
  tracker.start(before);
  tracker.process(seen_frame(model, before, wall_behind(0.5), 15));
  Configuration truth = before;
  truth.T_camera_base.pretranslate(0.08 *
                                   Eigen::Vector3d(-0.27043, -0.0996912, -0.957564).normalized());
  truth.T_camera_base.linear() =
      Eigen::AngleAxisd(0.1745, Eigen::Vector3d(0.678083, -0.0973812, 0.728506).normalized()) *
      before.T_camera_base.linear();
  DepthFrame frame = seen_frame(model, truth, wall_behind(0.5), 15);
  frame.stamp += 1.0 / 30.0;
  const TrackingResult& result = tracker.process(frame);
  EXPECT_EQ(result.status, TrackingStatus::tracking);
  const int slider = variable_of(model, "slider");
  EXPECT_NEAR(result.configuration.q[slider], truth.q[slider], 0.003);  // dragged by 26 mm
}

/// A door of the lockbox turns edge-on with its latch on it, so fast that the latch is contradicted
/// before the iterations of the frame are through: it must not be taken for one that leapt.
TEST(FastMotion, APartThatIsStillOnItsWayIsNotSoughtElsewhere) {
  const ArticulatedModel& model = shipped("lockbox");
  TrajectoryOptions options;
  options.frames = 40;
  const std::vector<State> run = generate_trajectory(model.tree, options);
  const int latch = variable_of(model, "latch");
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
