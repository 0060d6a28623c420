// SPDX-License-Identifier: BSD-3-Clause
// The derivatives of residuals by the model's size, and sides that are off as a whole.
#include "lockbox/terms/size_system.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <random>

namespace lockbox {
namespace {

class SizeSystemTest : public ::testing::Test {
 protected:
  Eigen::Vector3d any_vector() { return {uniform_(random_), uniform_(random_), uniform_(random_)}; }
  Eigen::Isometry3d any_pose() {
    Twist twist;
    twist << any_vector(), any_vector();
    Eigen::Isometry3d pose = exp_se3(twist);
    pose.translation().z() += 1.5;
    return pose;
  }

 private:
  std::mt19937 random_{41};
  std::uniform_real_distribution<double> uniform_{-0.5, 0.5};
};

TEST_F(SizeSystemTest, RowAgreesWithNumericalDifferentiation) {
  constexpr double kPixel = 0.0025;
  constexpr double kStep = 1e-6;
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Isometry3d T = any_pose();
    const Eigen::Vector3d base = any_pose().translation();
    const Eigen::Vector3d p_body = any_vector();
    const Eigen::Vector3d direction = any_vector().normalized();
    // Of the model's point, moved by all unknowns, along a fixed direction.
    const auto residual = [&](const SizeRow& x) {
      const Eigen::Vector3d moved = T * exp_se3(x.head<6>()) * p_body;
      return direction.dot(moved + size_motion(base, moved, x[6], x[7])) + kPixel * x[8];
    };
    const SizeRow row = size_row(T, base, T * p_body, direction, kPixel);
    for (Eigen::Index i = 0; i < row.size(); ++i) {
      const SizeRow step = kStep * SizeRow::Unit(i);
      EXPECT_NEAR(row[i], (residual(step) - residual(-step)) / (2.0 * kStep), 1e-8) << i;
    }
  }
}

TEST_F(SizeSystemTest, GrowsAboutTheBaseAcrossAndAlong) {
  const Eigen::Vector3d base(0.1, -0.2, 1.2);
  const Eigen::Vector3d motion =
      size_motion(base, base + Eigen::Vector3d(0.3, 0.2, 0.1), 0.02, 0.0);
  EXPECT_LT((motion - Eigen::Vector3d(0.006, 0.004, 0.0)).norm(), 1e-12);
  EXPECT_NEAR(size_motion(base, base + Eigen::Vector3d(0.3, 0.2, 0.1), 0.0, 0.02).z(), 0.002,
              1e-12);
}

/// Least squares with the covariance of residuals written out: each by itself, and those of a side
/// alike.
TEST_F(SizeSystemTest, EliminatesWhatSidesAreOff) {
  constexpr int kRows = 40;
  constexpr double kWeight = 3e5;  // 1 / m^2
  constexpr double kOff = 0.002;   // metres
  const std::vector<BodyJacobian> jacobians = {BodyJacobian::Identity(6, 6)};
  const std::vector<SizeSystem::Side> sides = {{0, true, Eigen::Vector3d::UnitX(), 0.1},
                                               {0, true, Eigen::Vector3d::UnitY(), 0.1},
                                               {0, false, Eigen::Vector3d::UnitX(), 0.1},
                                               {0, true, Eigen::Vector3d::UnitX(), 0.3}};
  SizeSystem system;
  system.set_zero(1);
  Eigen::MatrixXd rows(kRows, 9);
  Eigen::VectorXd residuals(kRows);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(kRows, kRows);
  for (int i = 0; i < kRows; ++i) {
    const SizeRow row = size_row(any_pose(), any_vector(), any_vector(), any_vector(), 0.002);
    rows.row(i) = row.transpose();
    residuals[i] = 0.01 * any_vector().x();
    system.add(sides[static_cast<std::size_t>(i) % sides.size()], row, residuals[i], kWeight);
    for (int j = 0; j < kRows; ++j) covariance(i, j) = i % 4 == j % 4 ? kOff * kOff : 0.0;
    covariance(i, i) += 1.0 / kWeight;
  }
  Eigen::MatrixXd hessian = Eigen::MatrixXd::Zero(9, 9);
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(9);
  system.add_to(jacobians, kOff, hessian, gradient);
  const Eigen::MatrixXd weighted = covariance.ldlt().solve(rows);
  const Eigen::MatrixXd expected = rows.transpose() * weighted;
  EXPECT_LT((hessian - expected).norm(), 1e-9 * expected.norm());
  const Eigen::VectorXd expected_gradient = weighted.transpose() * residuals;
  EXPECT_LT((gradient - expected_gradient).norm(), 1e-9 * expected_gradient.norm());
}

}  // namespace
}  // namespace lockbox
