// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/registration/noise_covariance.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>
#include <vector>

namespace lockbox {
namespace {

constexpr int kWidth = 22;
constexpr int kHeight = 17;
constexpr int kPixels = kWidth * kHeight;
constexpr double kSigma = 2.0;
constexpr double kLength = 3.0;

/// Along one axis, cut off at three lengths.
double correlation(int distance) {
  const double lengths = distance / kLength;
  return std::abs(lengths) <= 3.0 ? std::exp(-0.5 * lengths * lengths) : 0.0;
}

class NoiseCovarianceTest : public ::testing::Test {
 protected:
  NoiseCovarianceTest() {
    std::mt19937 random(1);
    std::uniform_int_distribution<int> weight(0, 5);  // 0: left out
    std::normal_distribution<float> number;
    for (int i = 0; i < kPixels; ++i) {
      weights_.push_back(static_cast<float>(weight(random)));
      residuals_.push_back(number(random));
    }
    covariance_.set_weights(kWidth, kHeight, weights_);
  }

  /// The same from the whole matrix, left-out pixels aside.
  Eigen::VectorXd solved_densely() const {
    std::vector<int> kept;
    for (int i = 0; i < kPixels; ++i) {
      if (weights_[static_cast<std::size_t>(i)] > 0.0F) kept.push_back(i);
    }
    const auto count = static_cast<Eigen::Index>(kept.size());
    Eigen::MatrixXd C(count, count);
    Eigen::VectorXd r(count);
    for (Eigen::Index a = 0; a < count; ++a) {
      const int i = kept[static_cast<std::size_t>(a)];
      r[a] = static_cast<double>(residuals_[static_cast<std::size_t>(i)]);
      for (Eigen::Index b = 0; b < count; ++b) {
        const int j = kept[static_cast<std::size_t>(b)];
        C(a, b) = kSigma * kSigma * correlation(i % kWidth - j % kWidth) *
                  correlation(i / kWidth - j / kWidth);
      }
      C(a, a) += 1.0 / static_cast<double>(weights_[static_cast<std::size_t>(i)]);
    }
    const Eigen::VectorXd x = C.ldlt().solve(r);
    Eigen::VectorXd image = Eigen::VectorXd::Zero(kPixels);
    for (Eigen::Index a = 0; a < count; ++a) image[kept[static_cast<std::size_t>(a)]] = x[a];
    return image;
  }

  double cost(const std::vector<float>& residuals) {
    covariance_.solve(residuals);
    return covariance_.chi_squared();
  }

  std::vector<float> weights_;
  std::vector<float> residuals_;
  NoiseCovariance covariance_{kSigma, kLength};
};

TEST_F(NoiseCovarianceTest, IsInvertedAsTheWholeMatrixIs) {
  const Eigen::VectorXd expected = solved_densely();
  const auto solution = covariance_.solve(residuals_);
  Eigen::VectorXd off(kPixels);
  double chi_squared = 0.0;
  for (Eigen::Index i = 0; i < kPixels; ++i) {
    const auto pixel = static_cast<std::size_t>(i);
    off[i] = static_cast<double>(solution[pixel]) - expected[i];
    chi_squared += expected[i] * static_cast<double>(residuals_[pixel]);
    EXPECT_TRUE(weights_[pixel] > 0.0F || solution[pixel] == 0.0F) << pixel;
  }
  EXPECT_LT(off.norm(), 0.02 * expected.norm());
  EXPECT_NEAR(covariance_.chi_squared(), chi_squared, 1e-3 * chi_squared);
}

TEST_F(NoiseCovarianceTest, IsTheSameFromTheLastSolution) {
  const double afresh = cost(residuals_);
  std::vector<float> shifted = residuals_;
  for (std::size_t i = 0; i < 40; ++i) shifted[i] += 1.0F;
  cost(shifted);
  EXPECT_NEAR(cost(residuals_), afresh, 2e-3 * afresh);
}

TEST_F(NoiseCovarianceTest, ForgivesWhatNeighboursShare) {
  std::vector<float> even(kPixels, 1.0F);
  std::vector<float> uneven(kPixels);
  for (std::size_t i = 0; i < uneven.size(); ++i) uneven[i] = i % 2 == 0 ? 1.0F : -1.0F;
  EXPECT_LT(cost(even), 0.02 * cost(uneven));
}

}  // namespace
}  // namespace lockbox
