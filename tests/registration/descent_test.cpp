// SPDX-License-Identifier: BSD-3-Clause
// The descent alone: where it ends, when it ends, and what it looks at on its way.
#include "descent.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "lockbox/core/lie.hpp"
#include "mechanism.hpp"

namespace lockbox {
namespace {

class DescentTest : public ::testing::Test {
 protected:
  Configuration off_by(double metres) const {
    Configuration start = truth_;
    start.T_camera_base.pretranslate(Eigen::Vector3d(metres, -metres, metres));
    return start;
  }
  double metres_off(const Configuration& found) const {
    return steps_.moves().between(truth_, found);
  }
  Descended run(const Configuration& start, const AlignOptions& align_options) {
    views_.forget();
    at_.begin(false);
    Descended found;
    const Comparison rough{cloud_, views_.rough, align_options.is_predicted};
    const Comparison close{cloud_, views_.close, align_options.is_predicted};
    descent_.run(&rough, close, start, align_options, at_, found);
    return found;
  }
  double cost_at(const Configuration& configuration) {
    Views views(options_);
    Linearization at;
    objective_.linearize({cloud_, views.close, false}, configuration, 0.0, at);
    return at.cost;
  }

  const ArticulatedModel& model_ = mechanism();
  const Configuration truth_ = mechanism_start(model_);
  const TiledCloud cloud_ = cloud_of(measured(model_, truth_, "primesense"));
  const RegistrationOptions options_{};
  Steps steps_{model_.tree, options_};
  Objective objective_{model_, options_, steps_.moves(), Executor(1)};
  Descent descent_{options_, objective_, steps_};
  Views views_{options_};
  Linearization at_;
};

TEST_F(DescentTest, EndsAtTheObjectWithALowerCost) {
  const Configuration start = off_by(0.006);
  const Descended found = run(start, {.annealing_sigma = 0.01, .iterations = 20, .narrowing = 6});
  EXPECT_LT(metres_off(found.configuration), 0.25 * metres_off(start));
  EXPECT_LT(cost_at(found.configuration), cost_at(start));
  EXPECT_LT(cost_at(found.configuration), cost_at(truth_)) << "noise is fitted, too";
}

TEST_F(DescentTest, ConvergesWhereNoStepIsWorthTaking) {
  const Descended found =
      run(off_by(0.003), {.annealing_sigma = 0.005, .iterations = 40, .narrowing = 4});
  ASSERT_TRUE(found.converged);
  EXPECT_LT(found.iterations, 40);
  EXPECT_EQ(found.last_step, Eigen::VectorXd::Zero(model_.tree.unknowns()));
  const Descended again = run(found.configuration, {.iterations = 40});
  EXPECT_TRUE(again.converged);
  EXPECT_LT(steps_.moves().between(found.configuration, again.configuration), 5e-4);
}

TEST_F(DescentTest, OneIterationIsNotEnoughToConverge) {
  const Descended found = run(off_by(0.006), {.annealing_sigma = 0.01, .iterations = 1});
  EXPECT_EQ(found.iterations, 1);
  EXPECT_FALSE(found.converged);
  EXPECT_GT(steps_.moves().of(found.last_step), 0.003) << "the step that was taken";
}

TEST_F(DescentTest, GatesAreNarrowAfterSoManyIterations) {
  std::vector<bool> narrow;
  const auto note = [&](const Configuration&, bool is_narrow) {
    narrow.push_back(is_narrow);
    return true;
  };
  run(off_by(0.006),
      {.annealing_sigma = 0.01, .iterations = 5, .narrowing = 3, .on_iteration = note});
  ASSERT_GE(narrow.size(), 3U);
  EXPECT_FALSE(narrow[0]);
  EXPECT_FALSE(narrow[1]);
  EXPECT_TRUE(narrow[2]);
}

TEST_F(DescentTest, TheFirstIterationHasTheWholeAnnealingSigma) {
  const Comparison close{cloud_, views_.close, false};
  const Configuration start = off_by(0.006);
  Linearization whole;
  objective_.linearize(close, start, 0.01, whole);
  const Eigen::VectorXd step = steps_.best(whole.all, start, false);
  const Descended found = run(start, {.annealing_sigma = 0.01, .iterations = 1, .narrowing = 9});
  EXPECT_EQ(found.last_step, step);
}

TEST_F(DescentTest, EndsWhenToldTo) {
  int reports = 0;
  const auto end_at_second = [&](const Configuration&, bool) { return ++reports < 2; };
  const Descended found = run(
      off_by(0.006), {.annealing_sigma = 0.01, .iterations = 10, .on_iteration = end_at_second});
  EXPECT_EQ(reports, 2);
  EXPECT_EQ(found.iterations, 2);
}

TEST_F(DescentTest, HoldsJoints) {
  const Configuration start = off_by(0.006);
  const Descended found =
      run(start, {.annealing_sigma = 0.01, .iterations = 8, .hold_joints = true});
  EXPECT_EQ(found.configuration.q, start.q);
  EXPECT_LT(metres_off(found.configuration), 0.5 * metres_off(start));
}

/// From a prediction the first iterations look at few points, the last one at all of the budget.
TEST_F(DescentTest, FromAPredictionEndsWithAllPoints) {
  const Descended found =
      run(off_by(0.002), {.annealing_sigma = 0.005, .iterations = 3, .is_predicted = true});
  EXPECT_TRUE(found.converged);
  ASSERT_TRUE(views_.rough.shows(found.configuration, steps_.moves()));
  ASSERT_TRUE(views_.close.shows(found.configuration, steps_.moves()));
  EXPECT_GT(views_.close.points().x().size(), 2 * views_.rough.points().x().size());
  const Comparison close{cloud_, views_.close, true};
  const double cost = at_.cost;
  objective_.linearize(close, found.configuration, 0.0, at_);
  EXPECT_NEAR(at_.cost, cost, 0.01 * std::abs(cost)) << "it was linearised in the close view";
}

TEST_F(DescentTest, OutsideAPredictionLooksCloselyFromTheBeginning) {
  run(off_by(0.002), {.annealing_sigma = 0.005, .iterations = 3});
  EXPECT_FALSE(views_.rough.shows(truth_, steps_.moves()));
  EXPECT_TRUE(views_.close.shows(truth_, steps_.moves()));
}

TEST_F(DescentTest, WouldRestWhereAShortStepLeads) {
  Descended ended;
  Configuration at_rest;
  const Comparison close{cloud_, views_.close, false};
  const Configuration solution =
      run(off_by(0.0), {.annealing_sigma = 0.005, .iterations = 20, .narrowing = 4}).configuration;
  for (const double off : {0.0002, 0.006}) {
    ended.configuration = solution;
    ended.configuration.T_camera_base.pretranslate(Eigen::Vector3d(0.0, 0.0, off));
    objective_.linearize(close, ended.configuration, 0.0, at_);
    descent_.find_rest(ended, at_, false, at_rest);
    const double moved = steps_.moves().between(ended.configuration, at_rest);
    if (off < 0.001) {
      EXPECT_GT(moved, 0.5 * off);
      EXPECT_LT(steps_.moves().between(solution, at_rest), 0.5 * off);
    } else {
      EXPECT_EQ(at_rest.q, ended.configuration.q) << "what is far is not guessed";
      EXPECT_EQ(at_rest.T_camera_base.matrix(), ended.configuration.T_camera_base.matrix());
    }
  }
}

/// Near the minimum what is left of a step is noise, and may lead uphill: then a part of it is
/// taken, or none.
TEST_F(DescentTest, TakesNoStepThatLeadsUphill) {
  RegistrationOptions exact;
  exact.step_tolerance = 0.0;
  Descent descent(exact, objective_, steps_);
  const Comparison close{cloud_, views_.close, false};
  Descended found{off_by(0.001), {}, 0, false};
  int uphill = 0;
  for (int i = 0; i < 12; ++i) {
    const Configuration start = found.configuration;
    at_.begin(true);
    descent.run(nullptr, close, start, {.iterations = 1}, at_, found);
    const Eigen::VectorXd whole = steps_.best(at_.all, start, false);
    const double moves = steps_.moves().of(found.last_step);
    EXPECT_LE(moves, steps_.moves().of(whole));
    if (moves > 0.0) {
      EXPECT_LT(objective_.cost(close, found.configuration, at_), at_.cost);
    }
    if (objective_.cost(close, stepped(start, whole), at_) < at_.cost) {
      EXPECT_EQ(found.last_step, whole);
    } else {
      EXPECT_LT(moves, steps_.moves().of(whole));
      ++uphill;
    }
  }
  EXPECT_GE(uphill, 1);
}

}  // namespace
}  // namespace lockbox
