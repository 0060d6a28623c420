// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "lockbox/core/lie.hpp"
#include "lockbox/solver/motion_metric.hpp"
#include "registration/mechanism.hpp"

namespace lockbox {
namespace {

class MotionMetricTest : public ::testing::Test {
 protected:
  MotionMetricTest() : moves_(model_.tree), start_(mechanism_start(model_)) {
    step_.setZero(model_.tree.unknowns());
  }

  Configuration moved_by(const Eigen::VectorXd& step) const {
    Configuration moved = start_;
    moved.T_camera_base = start_.T_camera_base * exp_se3(step.head<6>());
    moved.q += step.tail(step.size() - 6);
    return moved;
  }

  const ArticulatedModel& model_ = mechanism();
  MotionMetric moves_;
  Configuration start_;
  Eigen::VectorXd step_;  ///< base twist, then slide, turn, twist
};

TEST_F(MotionMetricTest, AreMetresForAllThatShifts) {
  step_[1] = 0.02;
  EXPECT_NEAR(moves_.of(step_), 0.02, 1e-12);
  step_.setZero();
  step_[6] = -0.03;
  EXPECT_NEAR(moves_.of(step_), 0.03, 1e-12);
}

TEST_F(MotionMetricTest, GrowWithTheDistanceFromTheAxisForAllThatTurns) {
  step_[7] = 0.1;  // the arm reaches 0.14 m from its axis, the knob on it not much farther
  EXPECT_GT(moves_.of(step_), 0.1 * 0.14);
  EXPECT_LT(moves_.of(step_), 0.1 * 0.20);
  step_.setZero();
  step_[3] = 0.1;  // the plate's corners are 0.2 m from any axis in it
  EXPECT_GT(moves_.of(step_), 0.1 * 0.2);
}

TEST_F(MotionMetricTest, OfAStepAreThoseBetweenItsEnds) {
  step_ << 0.01, -0.02, 0.005, 0.03, 0.01, -0.02, 0.015, 0.2, -0.3;
  EXPECT_NEAR(moves_.between(start_, moved_by(step_)), moves_.of(step_), 1e-9);
  EXPECT_NEAR(moves_.between(start_, start_), 0.0, 1e-12);
}

TEST_F(MotionMetricTest, AreSignificantOnlyWhereSeenAndBeyondTheNoise) {
  const Eigen::VectorXd sigma = Eigen::VectorXd::Constant(step_.size(), 0.01);
  std::vector<bool> observable(static_cast<std::size_t>(step_.size()), true);
  step_[6] = 0.015;  // noise
  EXPECT_EQ(moves_.of_significant(step_, observable, sigma), 0.0);
  step_[6] = 0.05;
  EXPECT_NEAR(moves_.of_significant(step_, observable, sigma), 0.05, 1e-12);
  observable[6] = false;
  EXPECT_EQ(moves_.of_significant(step_, observable, sigma), 0.0);
}

}  // namespace
}  // namespace lockbox
