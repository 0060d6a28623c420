// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/terms/patch_noise.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "lockbox/core/pinhole_camera.hpp"

namespace lockbox {
namespace {

constexpr int kSide = 6;

class PatchNoiseTest : public ::testing::Test {
 protected:
  /// Every other one errs by `own`, those of later rows by more.
  PatchNoiseTest() {
    for (int row = 0; row < kSide; ++row) {
      for (int column = row % 2; column < kSide; column += 2) pixels_.push_back({column, row});
    }
  }
  static float variance(const Pixel& pixel, float own) {
    return own * static_cast<float>(1 + pixel.v);
  }

  Eigen::MatrixXf covariance(float own) const {
    const auto count = static_cast<Eigen::Index>(pixels_.size());
    Eigen::MatrixXf C(count, count);
    for (Eigen::Index i = 0; i < count; ++i) {
      for (Eigen::Index j = 0; j < count; ++j) {
        const Pixel& a = pixels_[static_cast<std::size_t>(i)];
        const Pixel& b = pixels_[static_cast<std::size_t>(j)];
        const double distance = std::hypot(a.u - b.u, a.v - b.v) / sensor_.correlation_pixels;
        C(i, j) = noise_.shared_variance() *
                  static_cast<float>(1.0 + std::exp(-0.5 * distance * distance));
      }
      C(i, i) += variance(pixels_[static_cast<std::size_t>(i)], own);
    }
    return C;
  }

  Eigen::MatrixXf whitened(float own, const Eigen::MatrixXf& residuals) {
    noise_.clear(static_cast<std::size_t>(residuals.cols()));
    for (Eigen::Index i = 0; i < residuals.rows(); ++i) {
      const Pixel& pixel = pixels_[static_cast<std::size_t>(i)];
      const auto values = noise_.add(pixel.u, pixel.v, variance(pixel, own));
      Eigen::Map<Eigen::RowVectorXf>(values.data(), residuals.cols()) = residuals.row(i);
    }
    EXPECT_EQ(noise_.count(), pixels_.size());
    noise_.whiten();
    Eigen::MatrixXf result = Eigen::MatrixXf::Zero(residuals.rows(), residuals.cols());
    for (Eigen::Index i = 0; i < result.rows(); ++i) {
      const auto values = noise_.values(static_cast<std::size_t>(i));
      result.row(i) = Eigen::Map<const Eigen::RowVectorXf>(values.data(), result.cols());
    }
    return result;
  }

  std::vector<Pixel> pixels_;
  SensorNoise sensor_;
  PatchNoise noise_{sensor_, kSide};
};

TEST_F(PatchNoiseTest, MakesCorrelatedResidualsIndependent) {
  const float own = 0.2F * noise_.shared_variance();
  const Eigen::MatrixXf factor = covariance(own).llt().matrixL();
  for (int time = 0; time < 2; ++time) {  // the second time in the same memory
    EXPECT_TRUE(whitened(own, factor).isIdentity(1e-3F));
  }
}

TEST_F(PatchNoiseTest, MakesMuchOfStepsAndLittleOfLevels) {
  Eigen::MatrixXf residuals(pixels_.size(), 2);
  for (Eigen::Index i = 0; i < residuals.rows(); ++i) {
    residuals(i, 0) = std::sqrt(noise_.shared_variance());
    residuals(i, 1) = (i < residuals.rows() / 2 ? 1.0F : -1.0F) * residuals(i, 0);
  }
  const Eigen::MatrixXf white = whitened(0.1F * noise_.shared_variance(), residuals);
  EXPECT_LT(white.col(0).squaredNorm(), 1.0F);
  EXPECT_GT(white.col(1).squaredNorm(), 10.0F);
  EXPECT_NEAR(noise_.products().row(0)[1], white.col(0).dot(white.col(1)), 1e-3F);
}

TEST_F(PatchNoiseTest, SplitsTheNoiseOfThePixel) {
  const double total = sensor_.depth_quadratic * sensor_.depth_quadratic;
  const double own = static_cast<double>(noise_.own_variance(0.0F));
  EXPECT_NEAR(static_cast<double>(noise_.shared_variance()) + own, total, 1e-3 * total);
  const double rounding = sensor_.depth_floor * 4.0;  // of a depth of half a metre
  EXPECT_NEAR(static_cast<double>(noise_.own_variance(2.0F)), own + rounding * rounding,
              1e-3 * own);
}

}  // namespace
}  // namespace lockbox
