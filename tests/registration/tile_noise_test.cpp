// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/registration/tile_noise.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <vector>

namespace lockbox {
namespace {

constexpr int kSide = 6;

class TileNoiseTest : public ::testing::Test {
 protected:
  /// C of every other pixel, each of which errs by `own`, and by more in later rows.
  Eigen::MatrixXf add_pixels(float own) {
    std::vector<Pixel> pixels;
    std::vector<float> variances;
    noise_.clear();
    for (int row = 0; row < kSide; ++row) {
      for (int column = row % 2; column < kSide; column += 2) {
        pixels.push_back({column, row});
        variances.push_back(own * static_cast<float>(1 + row));
        noise_.add(column, row, variances.back());
      }
    }
    const auto count = static_cast<Eigen::Index>(pixels.size());
    EXPECT_EQ(noise_.count(), count);
    Eigen::MatrixXf C(count, count);
    for (Eigen::Index i = 0; i < count; ++i) {
      for (Eigen::Index j = 0; j < count; ++j) {
        const Pixel& a = pixels[static_cast<std::size_t>(i)];
        const Pixel& b = pixels[static_cast<std::size_t>(j)];
        const double distance = std::hypot(a.u - b.u, a.v - b.v) / sensor_.correlation_pixels;
        C(i, j) = noise_.shared_variance() *
                  static_cast<float>(1.0 + std::exp(-0.5 * distance * distance));
      }
      C(i, i) += variances[static_cast<std::size_t>(i)];
    }
    return C;
  }

  SensorNoise sensor_;
  TileNoise noise_{sensor_, kSide};
};

TEST_F(TileNoiseTest, MakesCorrelatedResidualsIndependent) {
  const float own = 0.2F * noise_.shared_variance();
  for (int time = 0; time < 2; ++time) {  // the second time in the same memory
    const Eigen::MatrixXf C = add_pixels(own);
    Eigen::MatrixXf factor = C.llt().matrixL();
    noise_.whiten(factor);
    EXPECT_TRUE(factor.isIdentity(1e-3F));
  }
}

TEST_F(TileNoiseTest, MakesMuchOfStepsAndLittleOfLevels) {
  add_pixels(0.1F * noise_.shared_variance());
  Eigen::MatrixXf residuals(noise_.count(), 2);
  for (Eigen::Index i = 0; i < residuals.rows(); ++i) {
    residuals(i, 0) = std::sqrt(noise_.shared_variance());
    residuals(i, 1) = (i < residuals.rows() / 2 ? 1.0F : -1.0F) * residuals(i, 0);
  }
  noise_.whiten(residuals);
  EXPECT_LT(residuals.col(0).squaredNorm(), 1.0F);
  EXPECT_GT(residuals.col(1).squaredNorm(), 10.0F);
}

TEST_F(TileNoiseTest, SplitsTheNoiseOfThePixel) {
  const double total = sensor_.depth_quadratic * sensor_.depth_quadratic;
  const double own = static_cast<double>(noise_.own_variance(0.0F));
  EXPECT_NEAR(static_cast<double>(noise_.shared_variance()) + own, total, 1e-3 * total);
  const double rounding = sensor_.depth_floor * 4.0;  // of a depth of half a metre
  EXPECT_NEAR(static_cast<double>(noise_.own_variance(2.0F)), own + rounding * rounding,
              1e-3 * own);
}

}  // namespace
}  // namespace lockbox
