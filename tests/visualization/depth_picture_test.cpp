// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/visualization/depth_picture.hpp"

#include <gtest/gtest.h>

namespace lockbox {
namespace {

TEST(DepthPicture, ShowsNearBrightFarDarkAndUnmeasuredBlack) {
  DepthFrame frame;
  frame.camera = {3, 1, 100.0, 100.0, 1.0, 0.0};
  frame.depth = {800, 2000, 0};
  const RgbImage image = depth_picture(frame);
  EXPECT_GT(image.rgb[0], 200);
  EXPECT_LT(image.rgb[3], 60);
  EXPECT_GT(image.rgb[3], 0);
  EXPECT_EQ(image.rgb[6], 0);
}

TEST(DepthPicture, IsBlackWhereNothingWasMeasuredAtAll) {
  DepthFrame frame;
  frame.camera = {2, 2, 100.0, 100.0, 0.5, 0.5};
  frame.depth.assign(4, 0);
  EXPECT_EQ(depth_picture(frame).rgb, std::vector<std::uint8_t>(12, 0));
}

}  // namespace
}  // namespace lockbox
