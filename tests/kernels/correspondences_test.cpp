// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/kernels/correspondences.hpp"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace lockbox::kernels {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Points on a plate, pulled to where a small motion would bring them, some of them far beyond.
class CorrespondencesTest : public ::testing::Test {
 protected:
  static constexpr std::size_t kCorrespondences = 70;  // no multiple of any number of lanes
  static constexpr CorrespondenceLoss kLoss{1e-6F, 3.0F};

  CorrespondencesTest() : arrays(kNumbers, std::vector<float>(kCorrespondences + kLanes, 1.0F)) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> uniform(-1.0F, 1.0F);
    T = Eigen::Translation3d(0.05, -0.02, 1.2) *
        Eigen::AngleAxisd(0.4, Eigen::Vector3d(0.3, 1.0, -0.2).normalized());
    for (std::size_t i = 0; i < kCorrespondences; ++i) {
      const Eigen::Vector3d p(0.3 * uniform(random), 0.2 * uniform(random), 0.02 * uniform(random));
      const Eigen::Vector3d n =
          Eigen::Vector3d(uniform(random), uniform(random), 0.2 * uniform(random)).normalized();
      const double off = i % 9 == 0 ? 0.05 : 0.003 * uniform(random);
      set(kP, i, p);
      set(kTarget, i, T * p - off * n);
      set(kDirection, i, n);
      arrays[kVariance][i] = 1e-6F * (2.0F + uniform(random));
      arrays[kTurn][i] = 0.01F * (2.0F + uniform(random));
      arrays[kPixels][i] = i % 2 == 0 ? 1.0F : 4.0F;
    }
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) {
        motion.rotation[3 * row + column] = static_cast<float>(T.linear()(row, column));
      }
      motion.translation[row] = static_cast<float>(T.translation()[row]);
    }
  }

  // Arrays: three for each vector.
  static constexpr std::size_t kP = 0;
  static constexpr std::size_t kTarget = 3;
  static constexpr std::size_t kDirection = 6;
  static constexpr std::size_t kVariance = 9;
  static constexpr std::size_t kTurn = 10;
  static constexpr std::size_t kPixels = 11;
  static constexpr std::size_t kNumbers = 12;

  void set(std::size_t first, std::size_t i, const Eigen::Vector3d& v) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      arrays[first + axis][i] = static_cast<float>(v[static_cast<Eigen::Index>(axis)]);
    }
  }
  Eigen::Vector3d vector(std::size_t first, std::size_t i) const {
    return Eigen::Vector3f(arrays[first][i], arrays[first + 1][i], arrays[first + 2][i])
        .cast<double>();
  }
  double number(std::size_t which, std::size_t i) const {
    return static_cast<double>(arrays[which][i]);
  }

  CorrespondenceSpan span() const { return span(0, kCorrespondences); }
  CorrespondenceSpan span(std::size_t first, std::size_t end) const {
    const auto at = [&](std::size_t number) { return arrays[number].data() + first; };
    return {{at(kP), at(kP + 1), at(kP + 2)},
            {at(kTarget), at(kTarget + 1), at(kTarget + 2)},
            {at(kDirection), at(kDirection + 1), at(kDirection + 2)},
            at(kVariance),
            at(kTurn),
            at(kPixels),
            end - first};
  }

  double residual(std::size_t i, const Eigen::Isometry3d& pose) const {
    return vector(kDirection, i).dot(pose * vector(kP, i) - vector(kTarget, i));
  }

  double exact_cost(const Eigen::Isometry3d& pose) const {
    double total = 0.0;
    const double c = 4.5;
    for (std::size_t i = 0; i < kCorrespondences; ++i) {
      const double s = std::pow(residual(i, pose), 2) / (number(kVariance, i) + 1e-6);
      total += number(kPixels, i) * (-std::log(std::exp(-c) + std::exp(-0.5 * s)) - c);
    }
    return total;
  }

  std::vector<std::vector<float>> arrays;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  RigidMotion motion{};
};

TEST_F(CorrespondencesTest, CostIsThatOfTheMixture) {
  const double exact = exact_cost(T);
  EXPECT_LT(exact, -100.0);  // most are explained
  EXPECT_NEAR(correspondence_cost(span(), motion, kLoss), exact, 1e-4 * std::abs(exact));
  EXPECT_EQ(accumulate_correspondences(span(), motion, kLoss).cost,
            correspondence_cost(span(), motion, kLoss));
}

TEST_F(CorrespondencesTest, GradientIsTheDerivativeOfTheCostInTheBodysTwist) {
  const NormalSums sums = accumulate_correspondences(span(), motion, kLoss).normal;
  constexpr double kStep = 1e-6;  // metres, radians: the sigma of a residual is 1e-3
  for (int k = 0; k < 6; ++k) {
    const auto moved = [&](double by) {
      Eigen::Isometry3d step = Eigen::Isometry3d::Identity();
      if (k < 3) {
        step.translation()[k] = by;
      } else {
        step.linear() = Eigen::AngleAxisd(by, Eigen::Vector3d::Unit(k - 3)).toRotationMatrix();
      }
      return exact_cost(T * step);
    };
    const double numeric = (moved(kStep) - moved(-kStep)) / (2.0 * kStep);
    EXPECT_NEAR(sums.gradient[k], numeric, 1e-4 * std::abs(numeric)) << k;
  }
}

TEST_F(CorrespondencesTest, SumsAreThoseOfTheWeightedRows) {
  const NormalSums sums = accumulate_correspondences(span(), motion, kLoss).normal;
  Matrix6 hessian = Matrix6::Zero();
  double mass = 0.0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < kCorrespondences; ++i) {
    const double inverse_variance = 1.0 / (number(kVariance, i) + 1e-6);
    const double gaussian = std::exp(-0.5 * std::pow(residual(i, T), 2) * inverse_variance);
    const double w = number(kPixels, i) * gaussian / (gaussian + std::exp(-4.5)) * inverse_variance;
    const Eigen::Vector3d p = vector(kP, i);
    const Eigen::Vector3d n = T.linear().transpose() * vector(kDirection, i);
    Vector6 row;
    row << n, p.cross(n);
    hessian += w * row * row.transpose();
    const double turning = w * number(kTurn, i);
    mass += turning;
    first += turning * p;
    second += turning * p * p.transpose();
  }
  int k = 0;
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column, ++k) {
      EXPECT_NEAR(sums.hessian[k], hessian(row, column), 1e-3 * hessian(0, 0));
    }
  }
  EXPECT_NEAR(sums.mass / mass, 1.0, 1e-3);
  k = 0;
  for (int row = 0; row < 3; ++row) {
    EXPECT_NEAR(sums.first_moment[row], first[row], 1e-3 * mass);
    for (int column = row; column < 3; ++column, ++k) {
      EXPECT_NEAR(sums.second_moment[k], second(row, column), 1e-3 * mass);
    }
  }
}

TEST_F(CorrespondencesTest, ProductsOfRunsAreTheSumsOfEach) {
  const std::vector<std::size_t> ends{1, 9, 25, 26, 42, kCorrespondences};
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    SCOPED_TRACE(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    std::vector<CorrespondenceProducts> products(ends.size());
    multiply_runs(span(), motion, kLoss, ends, products.data());
    std::size_t first = 0;
    for (std::size_t run = 0; run < ends.size(); ++run) {
      const NormalSums sums =
          accumulate_correspondences(span(first, ends[run]), motion, kLoss).normal;
      int k = 0;
      for (int row = 0; row < 6; ++row) {
        for (int column = row; column < 6; ++column, ++k) {
          EXPECT_NEAR(products[run].rows[row][column], sums.hessian[k], 1e-5 * sums.hessian[0]);
          EXPECT_EQ(products[run].rows[row][column], products[run].rows[column][row]);
        }
        EXPECT_NEAR(products[run].rows[6][row], sums.gradient[row], 1e-6 * sums.hessian[0]);
      }
      first = ends[run];
    }
  }
  hwy::SetSupportedTargetsForTest(0);
}

TEST_F(CorrespondencesTest, EveryInstructionSetOfTheMachineAgrees) {
  const double cost = correspondence_cost(span(), motion, kLoss);
  const NormalSums sums = accumulate_correspondences(span(), motion, kLoss).normal;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    EXPECT_NEAR(correspondence_cost(span(), motion, kLoss), cost, 1e-5 * std::abs(cost))
        << hwy::TargetName(target);
    const NormalSums own = accumulate_correspondences(span(), motion, kLoss).normal;
    for (int k = 0; k < 21; ++k) {
      EXPECT_NEAR(own.hessian[k], sums.hessian[k], 1e-5 * sums.hessian[0])
          << hwy::TargetName(target);
    }
  }
  hwy::SetSupportedTargetsForTest(0);
}

}  // namespace
}  // namespace lockbox::kernels
