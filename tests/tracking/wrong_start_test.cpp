// SPDX-License-Identifier: BSD-3-Clause
// Flat parts that a start puts far from where they are: there the camera measures what they would
// lie on, as near as their own backs.
#include <gtest/gtest.h>

#include <cmath>

#include "initialization/seen_model.hpp"
#include "lockbox/simulation/trajectory.hpp"
#include "lockbox/tracking/tracker.hpp"
#include "mechanism.hpp"
#include "wrong_joint.hpp"

namespace lockbox {
namespace {

class JointsThatStartWrong : public ::testing::TestWithParam<WrongJoint> {
 protected:
  const ArticulatedModel& model_ = shipped("lockbox");
  Configuration truth_ = [this] {
    Configuration configuration = rest_configuration(model_.tree);
    configuration.T_camera_base = facing_pose(1.25);
    return configuration;
  }();
};

TEST_P(JointsThatStartWrong, AreFoundAtOnce) {
  const int joint = joint_index(model_.tree, GetParam().name);
  const double right = joint_position(model_.tree, truth_, joint);
  Configuration start = truth_;
  set_joint_position(model_.tree, start, GetParam().name, right + GetParam().off);
  Tracker tracker(model_, {});
  tracker.start(start);
  for (std::uint64_t number = 0; number < 2; ++number) {
    const auto& result = tracker.process(seen_frame(model_, truth_, wall_behind(0.6), number));
    EXPECT_EQ(result.status, TrackingStatus::tracking);
    EXPECT_NEAR(joint_position(model_.tree, result.configuration, joint), right, 0.01);
    EXPECT_EQ(result.searches, 0);
  }
}

/// A flat back in a wall is explained by it wherever it lies: nobody can tell it from a part that
/// is flush with its neighbours. So a start that was given is kept there, but never trusted;
/// without it the object is found.
TEST(AStartInTheWall, IsNotTrustedAndHidesNothingFromASearch) {
  const ArticulatedModel& model = mechanism();
  Configuration truth = mechanism_start(model);
  truth.T_camera_base.pretranslate(Eigen::Vector3d(-0.3, -0.1, 0.3));
  Configuration start = truth;
  start.T_camera_base = Eigen::Translation3d(0.4, 0.2, 1.31);
  const DepthFrame frame = measured(model, truth, "primesense");
  Tracker given(model, {});
  given.start(start);
  EXPECT_EQ(given.process(frame).status, TrackingStatus::uncertain);
  Tracker searching(model, {});
  const TrackingResult& result = searching.process(frame);
  EXPECT_EQ(result.status, TrackingStatus::tracking);
  EXPECT_TRUE(result.configuration.T_camera_base.isApprox(truth.T_camera_base, 5e-3));
}

/// With less and less of the noise between a flat part's faces.
TEST(JointsThatStartRight, AreTrustedFromNearAndFar) {
  const ArticulatedModel& model = shipped("lockbox");
  Configuration truth = rest_configuration(model.tree);
  set_joint_position(model.tree, truth, "block", 0.1);
  set_joint_position(model.tree, truth, "slider", 0.12);
  for (double distance = 0.9; distance < 2.5; distance += 0.25) {
    truth.T_camera_base = facing_pose(distance);
    Tracker tracker(model, {});
    tracker.start(truth);
    const auto number = static_cast<std::uint64_t>(100.0 * distance);
    const auto& result = tracker.process(seen_frame(model, truth, wall_behind(0.6), number));
    EXPECT_EQ(result.status, TrackingStatus::tracking) << distance;
    EXPECT_EQ(result.searches, 0) << distance;
  }
}

INSTANTIATE_TEST_SUITE_P(Tracker, JointsThatStartWrong,
                         ::testing::Values(WrongJoint{"latch", 1.5}, WrongJoint{"latch", -1.5},
                                           WrongJoint{"block", 0.2}, WrongJoint{"slider", 0.25},
                                           WrongJoint{"cylinder_vertical", 0.12},
                                           WrongJoint{"disk", 1.0}, WrongJoint{"disk", -2.0}));

}  // namespace
}  // namespace lockbox
