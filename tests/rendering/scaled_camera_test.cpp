// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "lockbox/rendering/depth_renderer.hpp"
#include "test_scene.hpp"

namespace lockbox {
namespace {

using testing::vga_camera;

TEST(ScaledCamera, ReducedPixelIsTheMeanOfItsBlock) {
  const PinholeCamera camera = vga_camera();
  const PinholeCamera half = reduced(camera, 2);
  EXPECT_EQ(half.width, 320);
  EXPECT_EQ(half.height, 240);
  // The block of pixel (10, 20) holds columns 20 and 21, rows 40 and 41.
  EXPECT_TRUE(half.back_project(10, 20, 1.0).isApprox(camera.back_project(20.5, 40.5, 1.0)));
}

TEST(ScaledCamera, RefinedSamplesHoldThePixelCentres) {
  const PinholeCamera camera = vga_camera();
  const PinholeCamera fine = refined(camera, 2);
  EXPECT_EQ(fine.width, 1279);
  EXPECT_EQ(fine.height, 959);
  EXPECT_TRUE(fine.back_project(2 * 17, 2 * 5, 1.0).isApprox(camera.back_project(17, 5, 1.0)));
}

}  // namespace
}  // namespace lockbox
