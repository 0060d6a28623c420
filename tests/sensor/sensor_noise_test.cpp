// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/sensor/sensor_noise.hpp"

#include <gtest/gtest.h>

namespace lockbox {
namespace {

TEST(SensorNoise, GrowsAsItsPolynomialDoes) {
  SensorNoise noise;
  noise.depth_floor = 0.001;
  noise.depth_linear = -0.0005;
  noise.depth_quadratic = 0.0003;
  EXPECT_DOUBLE_EQ(noise.sigma_z(2.0), 0.001 - 0.001 + 0.0012);
}

TEST(SensorNoise, ShareThatIsAlikeCountsOverItsArea) {
  SensorNoise noise;
  noise.own_share = 0.6;  // 0.64 of the variance is shared
  noise.correlation_pixels = 3.0;
  EXPECT_NEAR(noise.correlation_area(), 0.36 + 0.64 * 56.5487, 1e-3);
}

TEST(SensorNoise, PixelsThatErrByThemselvesCountOneByOne) {
  SensorNoise noise;
  noise.own_share = 1.0;
  EXPECT_DOUBLE_EQ(noise.correlation_area(), 1.0);
  noise.own_share = 0.0;
  noise.correlation_pixels = 0.0;
  EXPECT_DOUBLE_EQ(noise.correlation_area(), 1.0);
}

}  // namespace
}  // namespace lockbox
