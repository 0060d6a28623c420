// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/frame_outcome.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "slider_and_dial.hpp"

namespace lockbox {
namespace {

class FrameOutcomes : public testing::Test {
 protected:
  FrameOutcomes() {
    result_.status = TrackingStatus::tracking;
    result_.configuration = truth_.configuration;
    result_.observable.assign(8, true);
    result_.sigma = Eigen::VectorXd::Constant(8, 0.001);
  }
  FrameOutcome outcome() const { return compare(tree_, result_, truth_); }

  KinematicTree tree_ = slider_and_dial();
  State truth_ = state_at(0.0, {0, 0, 1}, 0.1, 0.0);
  TrackingResult result_;
};

TEST_F(FrameOutcomes, TheTruthIsRightAndAtNoiseLevel) {
  EXPECT_TRUE(outcome().is_right());
  EXPECT_TRUE(outcome().is_at_noise_level());
  EXPECT_FALSE(outcome().is_wrongly_trusted());
}

TEST_F(FrameOutcomes, FiveMillimetresAreRightButNotAtNoiseLevel) {
  result_.configuration.T_camera_base.translation().x() += 0.005;
  EXPECT_NEAR(outcome().translation, 0.005, 1e-12);
  EXPECT_TRUE(outcome().is_right());
  EXPECT_FALSE(outcome().is_at_noise_level());
}

TEST_F(FrameOutcomes, AJointBeyondItsToleranceIsTrustedWronglyUnlessItIsUnobservable) {
  result_.configuration.q[0] += 0.012;  // tolerance: 0.01
  EXPECT_NEAR(outcome().joints, 1.2, 1e-9);
  EXPECT_EQ(outcome().worst_joint, "slider");
  EXPECT_TRUE(outcome().is_wrongly_trusted());
  result_.observable[6] = false;
  EXPECT_FALSE(outcome().is_wrongly_trusted());
}

TEST_F(FrameOutcomes, WhatIsUncertainIsNotTrusted) {
  result_.configuration.T_camera_base.translation().x() += 0.1;
  EXPECT_TRUE(outcome().is_wrongly_trusted());
  result_.status = TrackingStatus::uncertain;
  EXPECT_FALSE(outcome().is_wrongly_trusted());
}

TEST_F(FrameOutcomes, NothingKnownIsNotRight) {
  result_.configuration = unknown_configuration(tree_);
  EXPECT_TRUE(std::isnan(outcome().translation));
  EXPECT_FALSE(outcome().is_right());
}

TEST_F(FrameOutcomes, AreCountedByWhatTheyAreAndWhatTheyAreCalled) {
  std::vector<FrameOutcome> frames{outcome(), outcome()};
  result_.status = TrackingStatus::uncertain;
  frames.push_back(outcome());
  result_.configuration.T_camera_base.translation().x() += 0.1;
  frames.push_back(outcome());
  result_.status = TrackingStatus::tracking;
  frames.push_back(outcome());
  StatusCount count = count_statuses(frames);
  EXPECT_EQ(count.tracking, 3U);
  EXPECT_EQ(count.tracking_but_wrong, 1U);
  EXPECT_EQ(count.right, 3U);
  EXPECT_EQ(count.right_but_not_tracking, 1U);
  count += count;
  EXPECT_EQ(count.right, 6U);
}

TEST_F(FrameOutcomes, BecomeStatesWithTheJointsDeviations) {
  result_.observable[7] = false;
  const StatesFile states = to_states(tree_, {result_});
  EXPECT_EQ(states.extra_columns, (std::vector<std::string>{"slider.sigma", "dial.sigma"}));
  ASSERT_EQ(states.states.size(), 1U);
  EXPECT_EQ(states.states[0].status, "tracking");
  EXPECT_EQ(states.states[0].extra, (std::vector<std::string>{"0.001", "inf"}));
}

}  // namespace
}  // namespace lockbox
