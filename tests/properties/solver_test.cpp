// SPDX-License-Identifier: BSD-3-Clause
// Property "the solver is a solver": a linear problem in one undamped step, limits as active
// bounds, no step without information; a hidden joint stays where it is and nothing visible
// freezes.
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "lockbox/registration/bounded_step.hpp"

namespace lockbox {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

NormalEquations random_equations(int n, std::mt19937& random) {
  std::normal_distribution<double> normal;
  Eigen::MatrixXd A(n + 2, n);
  NormalEquations equations;
  equations.gradient.resize(n);
  for (Eigen::Index i = 0; i < A.size(); ++i) {
    A.data()[i] = normal(random);
  }
  for (int i = 0; i < n; ++i) {
    equations.gradient[i] = normal(random);
  }
  equations.hessian = A.transpose() * A;
  equations.information = equations.hessian;
  return equations;
}

StepLimits no_limits(int n) {
  return {Eigen::VectorXd::Constant(n, -kInfinity), Eigen::VectorXd::Constant(n, kInfinity)};
}

StepScale unit_scale(int n) {
  return {Eigen::VectorXd::Ones(n), 1e-12};
}

Eigen::VectorXd solve(const NormalEquations& equations, double damping, const StepLimits& limits,
                      const StepScale& scale) {
  return BoundedStepSolver().solve(equations, damping, limits, scale);
}

double quadratic(const NormalEquations& equations, const Eigen::VectorXd& s) {
  return equations.gradient.dot(s) + 0.5 * s.dot(equations.hessian * s);
}

TEST(BoundedStepTest, SolvesLinearProblemExactlyWithoutDamping) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 50; ++trial) {
    const NormalEquations equations = random_equations(9, random);
    const Eigen::VectorXd step = solve(equations, 0.0, no_limits(9), unit_scale(9));
    EXPECT_LT((equations.hessian * step + equations.gradient).norm(), 1e-8);
  }
}

TEST(BoundedStepTest, ActiveLimitsReachTheConstrainedOptimumOfABruteForceSearch) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> size(0.0, 0.4);
  for (int trial = 0; trial < 200; ++trial) {
    const int n = 3;
    const NormalEquations equations = random_equations(n, random);
    StepLimits limits = no_limits(n);
    for (int i = 0; i < n; ++i) {
      limits.lower[i] = -size(random);
      limits.upper[i] = size(random);
    }
    const Eigen::VectorXd step = solve(equations, 0.0, limits, unit_scale(n));
    const double reached = quadratic(equations, step);
    constexpr int kGrid = 40;
    for (int k = 0; k < kGrid * kGrid * kGrid; ++k) {
      Eigen::VectorXd s(n);
      for (int i = 0, rest = k; i < n; ++i, rest /= kGrid) {
        s[i] = limits.lower[i] + (limits.upper[i] - limits.lower[i]) * (rest % kGrid) / (kGrid - 1);
      }
      ASSERT_LE(reached, quadratic(equations, s) + 1e-9) << "trial " << trial;
    }
    EXPECT_TRUE((step.array() >= limits.lower.array() - 1e-12).all());
    EXPECT_TRUE((step.array() <= limits.upper.array() + 1e-12).all());
  }
}

TEST(BoundedStepTest, HeldUnknownsDoNotMove) {
  std::mt19937 random(3);
  const NormalEquations equations = random_equations(6, random);
  StepLimits limits = no_limits(6);
  limits.lower[2] = limits.upper[2] = 0.0;
  limits.lower[5] = limits.upper[5] = 0.0;
  const Eigen::VectorXd step = solve(equations, 0.0, limits, unit_scale(6));
  EXPECT_EQ(step[2], 0.0);
  EXPECT_EQ(step[5], 0.0);
  EXPECT_GT(step.norm(), 0.0);
}

TEST(BoundedStepTest, DirectionsWithoutInformationAreLeftAlone) {
  // x + y is measured, x - y is not.
  NormalEquations equations;
  equations.hessian = Eigen::Matrix2d::Ones() * 100.0;
  equations.information = equations.hessian;
  equations.gradient = Eigen::Vector2d(30.0, 30.0);
  StepScale scale = unit_scale(2);
  scale.least_information = 1.0;
  const Eigen::VectorXd step = solve(equations, 0.0, no_limits(2), scale);
  EXPECT_NEAR(step[0], -0.15, 1e-12);
  EXPECT_NEAR(step[1], -0.15, 1e-12);
}

TEST(BoundedStepTest, UnitsDecideWhatCountsAsInformation) {
  NormalEquations equations;
  equations.hessian = Eigen::Matrix2d::Identity() * 100.0;
  equations.information = equations.hessian;
  equations.gradient = Eigen::Vector2d(-10.0, -10.0);
  StepScale scale{Eigen::Vector2d(1.0, 0.05), 1.0};  // 100 * 0.05^2 = 0.25 < 1
  const Eigen::VectorXd step = solve(equations, 0.0, no_limits(2), scale);
  EXPECT_NEAR(step[0], 0.1, 1e-12);
  EXPECT_EQ(step[1], 0.0);
}

TEST(BoundedStepTest, DampingShortensTheStep) {
  std::mt19937 random(4);
  const NormalEquations equations = random_equations(5, random);
  const double free = solve(equations, 0.0, no_limits(5), unit_scale(5)).norm();
  const double damped = solve(equations, 10.0, no_limits(5), unit_scale(5)).norm();
  EXPECT_LT(damped, free);
}

}  // namespace
}  // namespace lockbox
