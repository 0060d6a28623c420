// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/core/pinhole_fit.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace lockbox {
namespace {

const PinholeCamera kCamera{64, 48, 70.0, 72.0, 30.5, 25.0};

/// Points of a rough surface, seen by columns [0, last_column).
PinholeFit fit_of(double noise_pixels, int last_column = kCamera.width) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> depth(0.8, 1.4);
  std::normal_distribution<double> noise(0.0, 1.0);
  PinholeFit fit;
  for (int v = 0; v < kCamera.height; ++v) {
    for (int u = 0; u < last_column; ++u) {
      const double z = depth(random);
      fit.add(u, v, kCamera.back_project(u + noise_pixels * noise(random), v, z));
    }
  }
  return fit;
}

TEST(PinholeFit, RecoversTheCameraThatSawThePoints) {
  PinholeFit fit = fit_of(0.0);
  fit.add(3.0, 4.0, Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()));
  fit.add(3.0, 4.0, Eigen::Vector3d(0.1, 0.1, -1.0));
  ASSERT_TRUE(fit.is_determined());
  EXPECT_TRUE(fit.is_pinhole());
  const PinholeCamera camera = fit.camera(kCamera.width, kCamera.height);
  EXPECT_NEAR(camera.fx, kCamera.fx, 1e-6);
  EXPECT_NEAR(camera.fy, kCamera.fy, 1e-6);
  EXPECT_NEAR(camera.cx, kCamera.cx, 1e-6);
  EXPECT_NEAR(camera.cy, kCamera.cy, 1e-6);
}

TEST(PinholeFit, StatesHowFarPointsAreFromTheRays) {
  EXPECT_NEAR(fit_of(0.3).residual(), 0.3, 0.02);
  EXPECT_TRUE(fit_of(0.3).is_pinhole());
  EXPECT_FALSE(fit_of(1.0).is_pinhole());
}

TEST(PinholeFit, OneColumnDeterminesNoCamera) {
  EXPECT_FALSE(fit_of(0.0, 1).is_determined());
  EXPECT_FALSE(PinholeFit().is_determined());
}

}  // namespace
}  // namespace lockbox
