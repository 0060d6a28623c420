// SPDX-License-Identifier: BSD-3-Clause
// The frame loop on a small mechanism: hidden joints, views without the object, good starts.
#include "lockbox/tracking/tracker.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/registration/articulated_registration.hpp"
#include "lockbox/tracking/answer.hpp"
#include "lockbox/tracking/classification.hpp"
#include "lockbox/verification/agreement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "mechanism.hpp"

namespace lockbox {
namespace {

constexpr int kTurn = 7;  ///< unknown of the joint `turn`

class TrackerTest : public ::testing::Test {
 protected:
  static TrackerOptions options() {
    TrackerOptions options;
    options.threads = 1;
    return options;
  }

  DepthFrame frame_of(const Configuration& configuration) {
    DepthFrame frame = measured(model, configuration, "primesense", ++frames_);
    frame.stamp = static_cast<double>(frames_) / 30.0;
    return frame;
  }

  Configuration with_turn(double angle) const {
    Configuration configuration = truth;
    set_joint_position(model.tree, configuration, "turn", angle);
    return configuration;
  }

  /// No depth wherever the arm may be, as behind a black cloth.
  DepthFrame with_arm_hidden(DepthFrame frame) const {
    BodyPoses poses;
    forward_kinematics(model.tree, truth, poses);
    const Joint& turn = *std::find_if(model.tree.joints.begin(), model.tree.joints.end(),
                                      [](const Joint& joint) { return joint.name == "turn"; });
    const Eigen::Vector3d axis = poses[static_cast<std::size_t>(turn.child_body)].translation();
    const PinholeCamera& camera = frame.camera;
    for (int v = 0; v < camera.height; ++v) {
      for (int u = 0; u < camera.width; ++u) {
        const Eigen::Vector3d p = camera.back_project(u, v, axis.z());
        auto& depth = frame.depth[static_cast<std::size_t>(v * camera.width + u)];
        if ((p - axis).norm() < 0.2) depth = 0;
      }
    }
    return frame;
  }

  const ArticulatedModel& model = mechanism();
  const Configuration truth = mechanism_start(model);
  Tracker tracker{model, options()};

 private:
  std::uint64_t frames_ = 0;
};

TEST_F(TrackerTest, TellsWhereTheTimeWent) {
  tracker.start(truth);
  const TrackingResult& result = tracker.process(frame_of(truth));
  EXPECT_GT(result.cloud_time.wall_ms, 0.0);
  EXPECT_GT(result.step_time.cpu_ms, 0.0);
  EXPECT_DOUBLE_EQ(result.latency_ms, result.cloud_time.wall_ms + result.step_time.wall_ms);
}

TEST_F(TrackerTest, AGoodStartNeedsNoSearch) {
  tracker.start(truth);
  for (int i = 0; i < 3; ++i) {
    const TrackingResult& result = tracker.process(frame_of(truth));
    EXPECT_EQ(result.status, TrackingStatus::tracking);
    EXPECT_EQ(result.searches, 0);
  }
}

/// A search of the whole frame takes as long as many frames. What comes into view when the camera
/// is uncovered is sought at once.
TEST_F(TrackerTest, SearchesInVainPauseForLongerAndLongerUntilTheViewIsAnother) {
  DepthFrame covered = frame_of(truth);
  std::fill(covered.depth.begin(), covered.depth.end(), std::uint16_t{0});
  std::vector<int> searched;
  int searches = 0;
  for (int i = 0; i < 150; ++i) {
    covered.depth.front() = static_cast<std::uint16_t>(500 + i);  // another image each time
    const TrackingResult& result = tracker.process(covered);
    if (result.searches > searches) searched.push_back(i);
    searches = result.searches;
  }
  EXPECT_EQ(searched, (std::vector{0, 1, 2, 4, 8, 16, 32, 64, 128}));
  EXPECT_EQ(tracker.process(frame_of(truth)).searches, searches + 1);
}

TEST_F(TrackerTest, WithoutTheObjectInViewNothingIsReported) {
  Configuration elsewhere = truth;
  elsewhere.T_camera_base.translation().x() = 5.0;  // the camera sees the wall alone
  const TrackingResult& result = tracker.process(frame_of(elsewhere));
  EXPECT_EQ(result.status, TrackingStatus::initializing);
  EXPECT_TRUE(std::isnan(result.configuration.T_camera_base.translation().x()));
  EXPECT_TRUE(std::isnan(result.configuration.q[0]));
}

TEST_F(TrackerTest, AJointThatMovedWhileItWasHiddenIsFoundAgain) {
  tracker.start(with_turn(0.3));
  for (int i = 0; i < 3; ++i) tracker.process(frame_of(with_turn(0.3)));
  for (int i = 0; i < 5; ++i) {
    const auto& hidden = tracker.process(with_arm_hidden(frame_of(with_turn(-0.5))));
    EXPECT_FALSE(hidden.observable[kTurn]) << i;
    EXPECT_EQ(hidden.status, TrackingStatus::tracking) << i;
  }
  TrackingResult found;
  for (int i = 0; i < 3; ++i) found = tracker.process(frame_of(with_turn(-0.5)));
  EXPECT_TRUE(found.observable[kTurn]);
  EXPECT_NEAR(found.configuration.q[1], -0.5, 0.02);
  EXPECT_EQ(found.searches, 0);
}

TEST_F(TrackerTest, AJointThatLeapsIsFoundInTheSameFrame) {
  tracker.start(with_turn(0.3));
  for (int i = 0; i < 3; ++i) tracker.process(frame_of(with_turn(0.3)));
  const TrackingResult& leapt = tracker.process(frame_of(with_turn(-0.9)));
  EXPECT_EQ(leapt.status, TrackingStatus::tracking);
  EXPECT_NEAR(leapt.configuration.q[1], -0.9, 0.02);
  EXPECT_EQ(leapt.searches, 0);
}

TEST_F(TrackerTest, ABaseThatLeapsIsFoundInTheSameFrame) {
  tracker.start(truth);
  for (int i = 0; i < 3; ++i) tracker.process(frame_of(truth));
  Configuration elsewhere = truth;
  elsewhere.T_camera_base.translation() += Eigen::Vector3d(0.05, 0.03, -0.05);
  elsewhere.T_camera_base.rotate(Eigen::AngleAxisd(0.15, Eigen::Vector3d::UnitX()));
  const TrackingResult& leapt = tracker.process(frame_of(elsewhere));
  EXPECT_EQ(leapt.status, TrackingStatus::tracking);
  EXPECT_LT(
      (leapt.configuration.T_camera_base.translation() - elsewhere.T_camera_base.translation())
          .norm(),
      3e-3);
  EXPECT_EQ(leapt.searches, 0);
}

TEST_F(TrackerTest, ALockedJointIsNotSought) {
  TrackerOptions locked = options();
  locked.registration.locked = {false, true, false};
  Tracker holding(model, locked);
  const TrackingResult& found = holding.process(frame_of(with_turn(0.02)));
  EXPECT_EQ(found.status, TrackingStatus::tracking);
  EXPECT_EQ(found.configuration.q[1], 0.0);
  EXPECT_NEAR(found.configuration.q[0], truth.q[0], 0.003);
}

TEST_F(TrackerTest, AnAlignmentThatIsStillOnItsWayIsUncertain) {
  Answer registered;
  registered.sigma = Eigen::VectorXd::Zero(6);
  registered.agreement.explained = 0.9;
  registered.last_move = options().most_last_move;
  EXPECT_EQ(classify(registered, options()), TrackingStatus::tracking);
  registered.last_move *= 1.01;
  EXPECT_EQ(classify(registered, options()), TrackingStatus::uncertain);
}

/// A door without its handle is no reason to doubt a board that is seen beyond doubt.
TEST_F(TrackerTest, APartThatContradictsIsDoubtedAloneWhereTheObjectIsBelieved) {
  Answer registered;
  const std::size_t bodies = model.tree.bodies.size();
  const auto unknowns = static_cast<std::size_t>(model.tree.unknowns());
  registered.sigma = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(unknowns));
  registered.observable.assign(unknowns, true);
  registered.agreement.explained = 0.9;
  registered.body_agreement.assign(bodies, {});
  Agreement& last = registered.body_agreement.back();
  last.pixels = 1000.0;
  last.explained = 0.5;
  last.contradicted = 0.5;
  EXPECT_EQ(classify(registered, options()), TrackingStatus::uncertain);
  registered.belief = options().convincing_belief;
  EXPECT_EQ(classify(registered, options()), TrackingStatus::tracking);
  const std::vector<bool> known = known_unknowns(registered, model.tree, options());
  EXPECT_EQ(std::count(known.begin(), known.end(), false), 1);
  std::swap(registered.body_agreement.front(), registered.body_agreement.back());
  EXPECT_EQ(classify(registered, options()), TrackingStatus::tracking) << "the base itself";
  registered.agreement.explained = 0.1;
  EXPECT_EQ(classify(registered, options()), TrackingStatus::uncertain) << "hardly anything";
  registered.agreement.explained = 0.9;
  registered.belief = 0.9;
  EXPECT_EQ(classify(registered, options()), TrackingStatus::uncertain) << "the base itself";
}

TEST_F(TrackerTest, AJointOfWhichTooLittleIsKnownIsNotReportedAsKnown) {
  Answer registered;
  const auto unknowns = static_cast<std::size_t>(model.tree.unknowns());
  registered.sigma = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(unknowns), 0.1);
  registered.observable.assign(unknowns, true);
  registered.body_agreement.assign(model.tree.bodies.size(), {});
  const std::vector<bool> known = known_unknowns(registered, model.tree, options());
  EXPECT_EQ(std::count(known.begin() + kBaseUnknowns, known.end(), true), 0);
}

}  // namespace
}  // namespace lockbox
