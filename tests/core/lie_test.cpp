// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/core/lie.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace lockbox {
namespace {

/// Twists that include the hard cases: nothing, tiny turns, half turns.
std::vector<Twist> twists() {
  std::vector<Twist> result{Twist::Zero()};
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (const double angle : {1e-12, 1e-6, 1e-4, 0.3, 1.7, 3.0, std::numbers::pi - 1e-7}) {
    Eigen::Vector3d axis(normal(random), normal(random), normal(random));
    Twist xi;
    xi << normal(random), normal(random), normal(random), angle * axis.normalized();
    result.push_back(xi);
  }
  return result;
}

TEST(LieTest, LogarithmInvertsExponential) {
  for (const Twist& xi : twists()) {
    EXPECT_LT((log_se3(exp_se3(xi)) - xi).norm(), 1e-8) << xi.transpose();
  }
}

TEST(LieTest, HalfTurnHasALogarithm) {
  for (const Eigen::Vector3d& axis : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0.6, -0.8, 0)}) {
    const Eigen::Matrix3d R = exp_so3(std::numbers::pi * axis);
    EXPECT_NEAR(log_so3(R).norm(), std::numbers::pi, 1e-9);
    EXPECT_LT((exp_so3(log_so3(R)) - R).norm(), 1e-9);
  }
}

TEST(LieTest, ExponentialOfSumOfParallelTwistsIsProduct) {
  for (const Twist& xi : twists()) {
    const Eigen::Isometry3d halves = exp_se3(0.3 * xi) * exp_se3(0.7 * xi);
    EXPECT_LT((halves.matrix() - exp_se3(xi).matrix()).norm(), 1e-9);
  }
}

TEST(LieTest, AdjointMovesTwistBetweenFrames) {
  const std::vector<Twist> all = twists();
  for (const Twist& a : all) {
    for (const Twist& b : all) {
      const Eigen::Isometry3d T = exp_se3(a);
      const Eigen::Isometry3d left = T * exp_se3(b) * T.inverse();
      EXPECT_LT((left.matrix() - exp_se3(adjoint(T) * b).matrix()).norm(), 1e-8);
    }
  }
}

TEST(LieTest, OrthonormalizedKeepsRotationsAndMendsDrift) {
  Eigen::Isometry3d T = exp_se3(twists()[5]);
  EXPECT_LT((orthonormalized(T).matrix() - T.matrix()).norm(), 1e-12);
  T.linear() *= 1.001;
  const Eigen::Matrix3d R = orthonormalized(T).linear();
  EXPECT_LT((R.transpose() * R - Eigen::Matrix3d::Identity()).norm(), 1e-12);
}

}  // namespace
}  // namespace lockbox
