// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/cloud/thinned_points.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <vector>

#include "lockbox/cloud/image_points.hpp"

namespace lockbox {
namespace {

const PinholeCamera kSlopeCamera{100, 70, 80.0, 90.0, 49.0, 34.5};
constexpr int kCell = SamplingDensity::kCellSize;

/// A slope with some holes.
TiledCloud slope() {
  std::vector<float> depth(static_cast<std::size_t>(kSlopeCamera.width * kSlopeCamera.height));
  std::mt19937 random(3);
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const bool is_hole = random() % 10 == 0;
    depth[i] = is_hole ? 0.0F : 1.0F + 0.001F * static_cast<float>(i % 100);
  }
  TiledCloud cloud;
  cloud.assign(kSlopeCamera, depth, {}, Executor(1));
  return cloud;
}

/// The same spacing everywhere.
SamplingDensity even(int spacing) {
  SamplingDensity density;
  density.columns = (kSlopeCamera.width + kCell - 1) / kCell;
  density.rows = (kSlopeCamera.height + kCell - 1) / kCell;
  density.spacing.assign(static_cast<std::size_t>(density.columns * density.rows),
                         static_cast<std::uint8_t>(spacing));
  return density;
}

ThinnedPoints thinned(const TiledCloud& cloud, const SamplingDensity& density) {
  ThinnedPoints points;
  points.assign(cloud, density);
  return points;
}

/// By pixel: index of the point.
std::map<std::uint32_t, std::size_t> by_pixel(const PointTiles& points) {
  std::map<std::uint32_t, std::size_t> found;
  for (const Tile& tile : points.tiles()) {
    for (std::size_t i = tile.first; i < tile.first + tile.count; ++i) {
      EXPECT_TRUE(found.emplace(points.pixel()[i], i).second) << "a pixel occurs twice";
    }
  }
  return found;
}

ImagePoints all_of(const TiledCloud& cloud) {
  ImagePoints points;
  points.assign(cloud, Executor(1));
  return points;
}

TEST(ThinnedPoints, WithoutGapsAreThePointsOfTheCloud) {
  const TiledCloud cloud = slope();
  const ThinnedPoints points = thinned(cloud, even(1));
  const ImagePoints image = all_of(cloud);
  const auto all = by_pixel(image);
  const auto found = by_pixel(points);
  ASSERT_EQ(found.size(), all.size());
  for (const auto& [pixel, i] : all) {
    const std::size_t k = found.at(pixel);
    EXPECT_EQ(points.x()[k], image.x()[i]);
    EXPECT_EQ(points.y()[k], image.y()[i]);
    EXPECT_EQ(points.z()[k], image.z()[i]);
  }
}

TEST(ThinnedPoints, AreThoseOfAGridThatMayBeFinerInSomeCells) {
  const TiledCloud cloud = slope();
  SamplingDensity density = even(4);
  density.spacing[1] = 2;   // columns 8 to 15 of the rows 0 to 7
  density.spacing[27] = 0;  // columns 8 to 15 of the rows 16 to 23
  const ThinnedPoints points = thinned(cloud, density);
  for (const auto& [pixel, i] : by_pixel(points)) {
    const auto u = static_cast<int>(pixel) % kSlopeCamera.width;
    const auto v = static_cast<int>(pixel) / kSlopeCamera.width;
    const int spacing = u / kCell == 1 && v / kCell == 0 ? 2 : 4;
    EXPECT_EQ(u % spacing, spacing / 2);
    EXPECT_EQ(v % spacing, spacing / 2);
    EXPECT_FALSE(u / kCell == 1 && v / kCell == 2);
  }
  const auto expected = static_cast<double>(all_of(cloud).valid_points()) / 16.0;
  EXPECT_NEAR(static_cast<double>(points.valid_points()), expected, 0.1 * expected);
}

TEST(ThinnedPoints, StandForThePixelsBetweenThem) {
  const TiledCloud cloud = slope();
  SamplingDensity density = even(4);
  density.spacing[1] = 2;
  density.spacing[2] = 1;
  density.spacing[3] = 8;
  const ThinnedPoints points = thinned(cloud, density);
  for (const Tile& tile : points.tiles()) {
    for (std::size_t i = tile.first; i < tile.first + tile.count; ++i) {
      const auto u = static_cast<int>(points.pixel()[i]) % kSlopeCamera.width;
      const auto v = static_cast<int>(points.pixel()[i]) / kSlopeCamera.width;
      const auto cell = static_cast<std::size_t>(v / kCell * density.columns + u / kCell);
      EXPECT_EQ(tile.weight, std::pow(density.spacing[cell], 2));
    }
  }
}

TEST(ThinnedPoints, AreOnlyThoseThatTheCloudKeeps) {
  TiledCloud cloud = slope();
  std::vector<std::uint8_t> mask(cloud.depth().size(), 0);
  for (std::size_t i = 0; i < mask.size(); i += 3) mask[i] = 1;
  cloud.keep(mask);
  for (std::size_t i = 0; i < mask.size(); ++i) mask[i] = i % 2 == 0 ? 1 : 0;
  cloud.keep(mask);
  EXPECT_EQ(by_pixel(thinned(cloud, even(1))).size(), all_of(cloud).valid_points());
  for (const auto& [pixel, i] : by_pixel(thinned(cloud, even(1)))) EXPECT_EQ(pixel % 6, 0U);
}

TEST(ThinnedPoints, OfAReducedViewAreThePixelsOfItsRays) {
  const TiledCloud cloud = slope();
  SamplingDensity density = even(2);
  density.columns = (kSlopeCamera.width / 2 + kCell - 1) / kCell;
  density.rows = (kSlopeCamera.height / 2 + kCell - 1) / kCell;
  density.scale = 2;
  density.spacing.resize(static_cast<std::size_t>(density.columns * density.rows));
  const ThinnedPoints points = thinned(cloud, density);
  EXPECT_GT(points.valid_points(), 300U);
  for (const auto& [pixel, i] : by_pixel(points)) {
    EXPECT_EQ(pixel % static_cast<std::uint32_t>(kSlopeCamera.width) % 4,
              3U);  // of every other column
    EXPECT_EQ(pixel / static_cast<std::uint32_t>(kSlopeCamera.width) % 4, 3U);
  }
  for (const Tile& tile : points.tiles()) EXPECT_EQ(tile.weight, 16.0);
}

}  // namespace
}  // namespace lockbox
