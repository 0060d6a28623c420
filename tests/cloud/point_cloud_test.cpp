// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/cloud/point_cloud.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lockbox/core/error.hpp"

namespace lockbox {
namespace {

/// 4 x 3 pixels that measure 2 m, but for pixel (1, 2).
DepthFrame small_frame() {
  DepthFrame frame;
  frame.camera = {4, 3, 10.0, 20.0, 1.5, 1.0};
  frame.depth.assign(12, 4000);
  frame.depth[2 * 4 + 1] = 0;
  frame.metres_per_unit = 0.0005F;
  frame.stamp = 12.345678;
  return frame;
}

TEST(PointCloud, IsOrganizedInTheCamerasFrame) {
  const auto cloud = to_point_cloud(small_frame());
  ASSERT_TRUE(cloud->isOrganized());
  EXPECT_EQ(cloud->width, 4U);
  EXPECT_EQ(cloud->height, 3U);
  EXPECT_EQ(cloud->header.stamp, 12345678U);
  // x = (3 - 1.5) / 10 * 2, y = (2 - 1) / 20 * 2
  EXPECT_NEAR(cloud->at(3, 2).x, 0.3F, 1e-6F);
  EXPECT_NEAR(cloud->at(3, 2).y, 0.1F, 1e-6F);
  EXPECT_NEAR(cloud->at(3, 2).z, 2.0F, 1e-6F);
}

TEST(PointCloud, HasNanWhereNothingWasMeasured) {
  const auto cloud = to_point_cloud(small_frame());
  EXPECT_FALSE(cloud->is_dense);
  for (int v = 0; v < 3; ++v) {
    for (int u = 0; u < 4; ++u) {
      const pcl::PointXYZ& point = cloud->at(u, v);
      const bool expected = u != 1 || v != 2;
      EXPECT_EQ(std::isfinite(point.x), expected);
      EXPECT_EQ(std::isfinite(point.y), expected);
      EXPECT_EQ(std::isfinite(point.z), expected);
    }
  }
}

TEST(PointCloud, OfATiledCloudHasItsFilteredDepth) {
  DepthFrame frame = small_frame();
  frame.depth[0] = 200;  // 0.1 m: too near
  TiledCloud tiled;
  tiled.assign(frame, {}, Executor(1));
  const auto cloud = to_point_cloud(tiled, frame.stamp);
  EXPECT_EQ(cloud->header.stamp, 12345678U);
  EXPECT_TRUE(std::isnan(cloud->at(0, 0).z));
  EXPECT_TRUE(std::isnan(cloud->at(1, 2).z));
  EXPECT_NEAR(cloud->at(3, 2).x, 0.3F, 1e-6F);
  EXPECT_NEAR(cloud->at(3, 2).y, 0.1F, 1e-6F);
  EXPECT_NEAR(cloud->at(3, 2).z, 2.0F, 1e-6F);
}

TEST(PointCloud, RefusesAnImageOfAnotherSize) {
  DepthFrame frame = small_frame();
  frame.depth.pop_back();
  EXPECT_THROW(to_point_cloud(frame), InputError);
}

}  // namespace
}  // namespace lockbox
