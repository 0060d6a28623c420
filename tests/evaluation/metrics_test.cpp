// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/metrics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "lockbox/core/error.hpp"
#include "slider_and_dial.hpp"

namespace lockbox {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

const Eigen::Vector3d kPlace(0.1, 0.2, 1.0);

class Metrics : public testing::Test {
 protected:
  KinematicTree tree_ = slider_and_dial();
};

StatesFile three_frames() {
  return {{},
          {state_at(0.0, kPlace, 0.05, 0.0), state_at(0.1, kPlace, 0.06, 0.1),
           state_at(0.2, kPlace, 0.07, 0.2)}};
}

/// A bound that determines everything, but for the given unknown (0 .. 7).
FrameBound bound_without(double stamp, int unknown) {
  FrameBound bound{stamp, Eigen::VectorXd::Constant(8, 1e-5)};
  bound.sigma[unknown] = kInfinity;
  return bound;
}

TEST_F(Metrics, MeasureTheBaseInMetresAndGeodesicRadians) {
  StatesFile estimate = three_frames();
  Eigen::Isometry3d& T = estimate.states[1].configuration.T_camera_base;
  T.translation() += Eigen::Vector3d(0.003, 0.0, -0.004);
  T.linear() = Eigen::AngleAxisd(0.02, Eigen::Vector3d(1.0, 1.0, 1.0).normalized()).matrix();
  const Evaluation evaluation = evaluate(tree_, estimate, three_frames());
  EXPECT_NEAR(evaluation.frames[1].translation, 0.005, 1e-12);
  EXPECT_NEAR(evaluation.frames[1].rotation, 0.02, 1e-12);
  EXPECT_NEAR(evaluation.translation.rmse, 0.005 / std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(evaluation.translation.maximum, 0.005, 1e-12);
  EXPECT_DOUBLE_EQ(evaluation.translation.median, 0.0);
}

TEST_F(Metrics, CompareContinuousJointsModuloATurnAndOthersAsTheyAre) {
  StatesFile estimate = three_frames();
  estimate.states[2].configuration.q = Eigen::Vector2d(0.069, 0.15 + 6.0 * kPi);
  const Evaluation evaluation = evaluate(tree_, estimate, three_frames());
  EXPECT_NEAR(evaluation.frames[2].joints[0], -0.001, 1e-12);
  EXPECT_NEAR(evaluation.frames[2].joints[1], -0.05, 1e-12);
}

TEST_F(Metrics, PairFramesWithinHalfAFrame) {
  StatesFile estimate = three_frames();
  estimate.states[0].stamp = 0.049;
  estimate.states[1].stamp = 0.151;  // nearer to the third frame than to its own
  estimate.states[2].stamp = 0.201;
  const Evaluation evaluation = evaluate(tree_, estimate, three_frames());
  EXPECT_EQ(evaluation.unmatched, 1U);
  EXPECT_NEAR(evaluation.frames[0].joints[0], 0.0, 1e-12);
  EXPECT_TRUE(std::isnan(evaluation.frames[1].translation));
  EXPECT_EQ(evaluation.frames[1].status, "");
  EXPECT_NEAR(evaluation.frames[2].joints[0], 0.0, 1e-12);
}

TEST_F(Metrics, LeaveFramesWithoutEstimateOutOfErrorsButNotOutOfTheShareTracked) {
  StatesFile estimate = three_frames();
  estimate.states[0].known = false;
  estimate.states[0].status = "initializing";
  const Evaluation evaluation = evaluate(tree_, estimate, three_frames());
  EXPECT_EQ(evaluation.translation.count, 2U);
  EXPECT_EQ(evaluation.joints[0].errors.count, 2U);
  EXPECT_EQ(evaluation.statuses.tracking, 2U);
  EXPECT_EQ(evaluation.frames.size(), 3U);
}

TEST_F(Metrics, CountAnUnknownOnlyWhereTheFrameDeterminesIt) {
  StatesFile estimate = three_frames();
  estimate.states[1].configuration.q[0] += 0.1;  // while the slider is hidden
  const std::vector<FrameBound> bounds = {bound_without(0.0, 0), bound_without(0.1, 6),
                                          bound_without(0.2, 4)};
  const Evaluation evaluation = evaluate(tree_, estimate, three_frames(), bounds);
  EXPECT_EQ(evaluation.translation.count, 2U);
  EXPECT_EQ(evaluation.rotation.count, 2U);
  EXPECT_EQ(evaluation.joints[0].errors.count, 2U);
  EXPECT_DOUBLE_EQ(evaluation.joints[0].errors.maximum, 0.0);
  EXPECT_EQ(evaluation.joints[1].errors.count, 3U);
}

TEST_F(Metrics, CallABoundDeterminedBelowAFifthOfTheTolerance) {
  Eigen::VectorXd sigma = Eigen::VectorXd::Zero(8);
  sigma[6] = 0.00199;                               // of 10 mm
  sigma[7] = 1.01 / 180.0 * kPi;                    // of 5 degrees
  sigma.segment<3>(0) << 0.0, 0.003, 0.00265;       // 4.003 mm of 20 mm
  sigma.segment<3>(3) << 0.39 / 180.0 * kPi, 0, 0;  // of 2 degrees
  const Determined determined = determined_unknowns(tree_, sigma);
  EXPECT_FALSE(determined.translation);
  EXPECT_TRUE(determined.rotation);
  EXPECT_TRUE(determined.joints[0]);
  EXPECT_FALSE(determined.joints[1]);
}

TEST_F(Metrics, AskHonestyWhereTheFrameDeterminesNothing) {
  StatesFile estimate = three_frames();
  estimate.extra_columns = {"slider.sigma"};
  for (State& state : estimate.states) state.configuration.q[0] += 0.03;
  estimate.states[0].extra = {"0.011"};  // 3 sigma = 33 mm: honest
  estimate.states[1].extra = {"0.009"};  // 27 mm: not
  estimate.states[2].extra = {"inf"};    // flagged
  std::vector<FrameBound> bounds;
  for (const State& state : estimate.states) bounds.push_back(bound_without(state.stamp, 6));
  const Evaluation evaluation = evaluate(tree_, estimate, three_frames(), bounds);
  EXPECT_EQ(evaluation.joints[0].errors.count, 0U);
  EXPECT_EQ(evaluation.joints[0].honesty.frames, 3U);
  EXPECT_EQ(evaluation.joints[0].honesty.honest, 2U);
}

TEST_F(Metrics, CompareTheStatusWithTolerances) {
  StatesFile estimate = three_frames();
  estimate.extra_columns = {"slider.sigma"};
  estimate.states[0].configuration.q[0] += 0.02;  // wrong, and called tracking
  estimate.states[0].extra = {"0.001"};
  estimate.states[1].configuration.q[0] += 0.02;  // the same, but admitted: a quarter of 0.2 m
  estimate.states[1].extra = {"0.05"};
  estimate.states[2].status = "uncertain";  // right, and not called tracking
  estimate.states[2].extra = {"0.001"};
  const StatusCount statuses = evaluate(tree_, estimate, three_frames()).statuses;
  EXPECT_EQ(statuses.tracking, 2U);
  EXPECT_EQ(statuses.tracking_but_wrong, 1U);
  EXPECT_EQ(statuses.right, 2U);
  EXPECT_EQ(statuses.right_but_not_tracking, 1U);
}

TEST_F(Metrics, RefuseStampsThatDoNotIncreaseAndEmptyFiles) {
  StatesFile backwards = three_frames();
  backwards.states[2].stamp = 0.1;
  EXPECT_THROW(evaluate(tree_, backwards, three_frames()), InputError);
  EXPECT_THROW(evaluate(tree_, three_frames(), StatesFile{}), InputError);
}

TEST_F(Metrics, RefuseASigmaThatIsNoNumber) {
  StatesFile estimate = three_frames();
  estimate.extra_columns = {"dial.sigma"};
  for (State& state : estimate.states) state.extra = {"much"};
  EXPECT_THROW(evaluate(tree_, estimate, three_frames()), InputError);
}

}  // namespace
}  // namespace lockbox
