// SPDX-License-Identifier: BSD-3-Clause
// Clouds without an image.
#include <gtest/gtest.h>

#include <cstddef>
#include <limits>
#include <random>
#include <vector>

#include "flat_frame.hpp"
#include "lockbox/cloud/tiled_cloud.hpp"
#include "points_of_tiles.hpp"

namespace lockbox {
namespace {

class UnorganizedCloudTest : public ::testing::Test {
 protected:
  UnorganizedCloudTest() {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> coordinate(0.5F, 1.5F);
    for (int i = 0; i < 5000; ++i) {
      points.emplace_back(coordinate(random), coordinate(random), coordinate(random));
    }
    points[10].x() = std::numeric_limits<float>::quiet_NaN();
    points[11].z() = -1.0F;
    cloud.assign(flat_frame(1000), {}, Executor(1));  // what was there before must not matter
    cloud.assign_unorganized(points, kSmallCamera);
  }

  std::vector<Eigen::Vector3f> points;
  TiledCloud cloud;
};

TEST_F(UnorganizedCloudTest, HoldsEachPointInFrontOnceAndNoImage) {
  EXPECT_FALSE(cloud.has_image());
  std::vector<int> seen(points.size(), 0);
  for_each_point(cloud.blocks(), [&](std::size_t i) {
    const auto point = cloud.blocks().pixel()[i];
    ++seen[point];
    EXPECT_EQ(Eigen::Vector3f(cloud.blocks().x()[i], cloud.blocks().y()[i], cloud.blocks().z()[i]),
              points[point]);
  });
  EXPECT_EQ(seen[10], 0);
  EXPECT_EQ(seen[11], 0);
  EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), 4998);
}

TEST_F(UnorganizedCloudTest, TilesAreFullAndCompact) {
  ASSERT_EQ(cloud.blocks().tiles().size(), 20U);  // 4998 / 256, rounded up
  float volume = 0.0F;
  for (const Tile& tile : cloud.blocks().tiles()) {
    EXPECT_TRUE(tile.count == kTilePoints || &tile == &cloud.blocks().tiles().back());
    volume += tile.bounds.volume();
  }
  EXPECT_LT(volume, 1.0F);  // of the cube: blocks that do not overlap
}

TEST_F(UnorganizedCloudTest, NoPointsGiveNoTiles) {
  cloud.assign_unorganized({}, kSmallCamera);
  EXPECT_TRUE(cloud.blocks().tiles().empty());
  EXPECT_EQ(cloud.blocks().valid_points(), 0U);
}

}  // namespace
}  // namespace lockbox
