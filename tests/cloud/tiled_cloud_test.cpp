// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/cloud/tiled_cloud.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include "flat_frame.hpp"
#include "lockbox/cloud/image_points.hpp"
#include "lockbox/core/error.hpp"
#include "points_of_tiles.hpp"

namespace lockbox {
namespace {

DepthFrame random_frame() {
  DepthFrame frame = flat_frame(0);
  std::mt19937 random(5);
  for (auto& depth : frame.depth) {
    depth = static_cast<std::uint16_t>(random() % 3 == 0 ? 0 : 900 + random() % 200);
  }
  return frame;
}

TiledCloud converted(const DepthFrame& frame, const CloudOptions& options = {}, int threads = 2) {
  TiledCloud cloud;
  cloud.assign(frame, options, Executor(threads));
  return cloud;
}

ImagePoints points_of(const TiledCloud& cloud, int threads = 2) {
  ImagePoints points;
  points.assign(cloud, Executor(threads));
  return points;
}

std::size_t count(const TiledCloud& cloud) {
  return points_of(cloud).valid_points();
}

TEST(ImagePoints, AreTheMeasurementsEachOnce) {
  const DepthFrame frame = random_frame();
  const ImagePoints points = points_of(converted(frame, {.flying_pixel_jump = 0.0}));
  std::vector<int> seen(frame.depth.size(), 0);
  for_each_point(points, [&](std::size_t i) {
    const auto pixel = points.pixel()[i];
    ++seen[pixel];
    const std::uint32_t row = pixel / 100;
    const auto expected =
        kSmallCamera.back_project(pixel - 100 * row, row, 0.001 * frame.depth[pixel]);
    EXPECT_NEAR(points.x()[i], expected.x(), 1e-6);
    EXPECT_NEAR(points.y()[i], expected.y(), 1e-6);
    EXPECT_NEAR(points.z()[i], expected.z(), 1e-6);
  });
  for (std::size_t pixel = 0; pixel < seen.size(); ++pixel) {
    EXPECT_EQ(seen[pixel], frame.depth[pixel] > 0 ? 1 : 0);
  }
}

TEST(ImagePoints, AreBoundedByTilesThatArePaddedWithNone) {
  const ImagePoints points = points_of(converted(random_frame()));
  ASSERT_EQ(points.tiles().size(), 7U * 5U);
  for (const Tile& tile : points.tiles()) {
    ASSERT_GT(tile.count, 0U);
    EXPECT_GE(tile.padded, tile.count);
    Eigen::AlignedBox3f bounds;
    for (std::size_t i = tile.first; i < tile.first + tile.count; ++i) {
      bounds.extend(Eigen::Vector3f(points.x()[i], points.y()[i], points.z()[i]));
    }
    EXPECT_TRUE(bounds.isApprox(tile.bounds));
    for (std::size_t i = tile.first + tile.count; i < tile.first + tile.padded; ++i) {
      EXPECT_FALSE(bounds.contains(Eigen::Vector3f(points.x()[i], points.y()[i], points.z()[i])));
    }
  }
}

TEST(TiledCloud, DropsWhatIsOutOfRange) {
  DepthFrame frame = flat_frame(0);
  frame.depth[pixel_at(3, 3)] = 499;
  frame.depth[pixel_at(5, 3)] = 500;
  frame.depth[pixel_at(7, 3)] = 2000;
  frame.depth[pixel_at(9, 3)] = 2001;
  const CloudOptions range{.min_depth = 0.4999, .max_depth = 2.0001, .flying_pixel_jump = 0.0};
  const TiledCloud cloud = converted(frame, range);
  EXPECT_EQ(count(cloud), 2U);
  EXPECT_EQ(cloud.depth()[pixel_at(3, 3)], 0.0F);
  EXPECT_NEAR(cloud.depth()[pixel_at(5, 3)], 0.5F, 1e-6F);
  EXPECT_NEAR(cloud.depth()[pixel_at(7, 3)], 2.0F, 1e-6F);
  EXPECT_EQ(cloud.depth()[pixel_at(9, 3)], 0.0F);
}

// Rows: 1 m | 1.2 | 1.4 m; the pixels at 1.2 m hang between the two surfaces.
TEST(TiledCloud, RemovesPixelsThatHangBetweenSurfaces) {
  DepthFrame frame = flat_frame(1000);
  for (int v = 0; v < kSmallCamera.height; ++v) {
    for (int u = 50; u < kSmallCamera.width; ++u) {
      frame.depth[pixel_at(u, v)] = u == 50 ? 1200 : 1400;
    }
  }
  const TiledCloud cloud = converted(frame);
  for (int v = 0; v < kSmallCamera.height; ++v) {
    EXPECT_NEAR(cloud.depth()[pixel_at(49, v)], 1.0F, 1e-6F);
    EXPECT_EQ(cloud.depth()[pixel_at(50, v)], 0.0F);
    EXPECT_NEAR(cloud.depth()[pixel_at(51, v)], 1.4F, 1e-6F);
  }
}

TEST(TiledCloud, KeepsBothSidesOfASharpEdge) {
  DepthFrame frame = flat_frame(1000);
  for (int v = 20; v < 50; ++v) {
    std::fill_n(frame.depth.begin() + static_cast<std::ptrdiff_t>(pixel_at(30, v)), 40, 700);
  }
  EXPECT_EQ(count(converted(frame)), frame.depth.size());
}

TEST(TiledCloud, FiltersTheMirroredImageAlike) {
  const DepthFrame frame = random_frame();
  DepthFrame mirrored = frame;
  DepthFrame flipped = frame;
  for (int v = 0; v < kSmallCamera.height; ++v) {
    for (int u = 0; u < kSmallCamera.width; ++u) {
      mirrored.depth[pixel_at(99 - u, v)] = frame.depth[pixel_at(u, v)];
      flipped.depth[pixel_at(u, 69 - v)] = frame.depth[pixel_at(u, v)];
    }
  }
  const TiledCloud cloud = converted(frame);
  const TiledCloud of_mirrored = converted(mirrored);
  const TiledCloud of_flipped = converted(flipped);
  const auto unmeasured = static_cast<std::size_t>(
      std::count(frame.depth.begin(), frame.depth.end(), std::uint16_t{0}));
  EXPECT_LT(count(cloud), frame.depth.size() - unmeasured);  // there is what to filter
  for (int v = 0; v < kSmallCamera.height; ++v) {
    for (int u = 0; u < kSmallCamera.width; ++u) {
      EXPECT_EQ(of_mirrored.depth()[pixel_at(99 - u, v)], cloud.depth()[pixel_at(u, v)]);
      EXPECT_EQ(of_flipped.depth()[pixel_at(u, 69 - v)], cloud.depth()[pixel_at(u, v)]);
    }
  }
}

TEST(TiledCloud, KeepsTheMaskedPixelsOnly) {
  const DepthFrame frame = random_frame();
  TiledCloud cloud = converted(frame, {.flying_pixel_jump = 0.0});
  const std::vector<float> depth = cloud.depth();
  std::vector<std::uint8_t> mask(frame.depth.size());
  std::size_t expected = 0;
  for (std::size_t pixel = 0; pixel < mask.size(); ++pixel) {
    mask[pixel] = pixel % 5 == 0 ? 1 : 0;
    expected += mask[pixel] != 0 && frame.depth[pixel] != 0 ? 1 : 0;
  }
  cloud.keep(mask);
  EXPECT_EQ(cloud.depth(), depth);
  const ImagePoints points = points_of(cloud);
  EXPECT_EQ(points.valid_points(), expected);
  for_each_point(points, [&](std::size_t i) {
    EXPECT_EQ(points.pixel()[i] % 5, 0U);
    EXPECT_NEAR(points.z()[i], depth[points.pixel()[i]], 1e-6F);
  });
}

TEST(TiledCloud, SameForAnyNumberOfThreads) {
  const DepthFrame frame = random_frame();
  const TiledCloud expected = converted(frame, {}, 1);
  const ImagePoints reference = points_of(expected, 1);
  for (const int threads : {2, 8}) {
    const TiledCloud cloud = converted(frame, {}, threads);
    EXPECT_EQ(cloud.depth(), expected.depth());
    const ImagePoints points = points_of(cloud, threads);
    ASSERT_EQ(points.valid_points(), reference.valid_points());
    for_each_point(reference, [&](std::size_t i) {
      EXPECT_EQ(points.pixel()[i], reference.pixel()[i]);
      EXPECT_EQ(points.x()[i], reference.x()[i]);
      EXPECT_EQ(points.y()[i], reference.y()[i]);
      EXPECT_EQ(points.z()[i], reference.z()[i]);
    });
  }
}

TEST(TiledCloud, IsReusedForAnotherImageSize) {
  TiledCloud cloud = converted(random_frame());
  ImagePoints points = points_of(cloud);
  DepthFrame small;
  small.camera = {8, 6, 10.0, 10.0, 3.5, 2.5};
  small.depth.assign(48, 1000);
  cloud.assign(small, {}, Executor(2));
  points.assign(cloud, Executor(2));
  EXPECT_EQ(points.tiles().size(), 1U);
  EXPECT_EQ(points.valid_points(), 48U);
}

/// A frame of nearer pixels would fly if something had been measured beyond the image, too.
TEST(TiledCloud, NothingIsMeasuredBeyondTheImageWhateverWasThereBefore) {
  DepthFrame wide;
  wide.camera = {30, 2, 10.0, 10.0, 14.5, 0.5};
  wide.depth.assign(60, 1100);
  DepthFrame small;
  small.camera = {8, 6, 10.0, 10.0, 3.5, 2.5};
  for (int v = 0; v < 6; ++v) {
    for (int u = 0; u < 8; ++u) {
      small.depth.push_back(u == 0 || v == 0 || u == 7 || v == 5 ? 700 : 1000);
    }
  }
  TiledCloud cloud = converted(wide);
  cloud.assign(small, {}, Executor(2));
  EXPECT_EQ(count(cloud), 48U);
}

TEST(TiledCloud, RefusesWhatDoesNotFitTogether) {
  TiledCloud cloud = converted(flat_frame(1000));
  DepthFrame frame = flat_frame(1000);
  frame.depth.pop_back();
  EXPECT_THROW(cloud.assign(frame, {}, Executor(1)), InputError);
  frame = flat_frame(1000);
  frame.camera.fx = 0.0;
  EXPECT_THROW(cloud.assign(frame, {}, Executor(1)), InputError);
  EXPECT_THROW(cloud.assign(DepthFrame(), {}, Executor(1)), InputError);
  EXPECT_THROW(cloud.keep(std::vector<std::uint8_t>(5, 1)), InputError);
}

TEST(TiledCloud, DepthsInMetresGiveTheSameCloudAsTheFrame) {
  const DepthFrame frame = random_frame();
  std::vector<float> metres;
  for (const std::uint16_t depth : frame.depth) {
    metres.push_back(depth == 0 ? std::numeric_limits<float>::quiet_NaN()
                                : static_cast<float>(depth) * frame.metres_per_unit);
  }
  const TiledCloud expected = converted(frame);
  TiledCloud cloud;
  cloud.assign(kSmallCamera, metres, {}, Executor(2));
  EXPECT_TRUE(cloud.has_image());
  EXPECT_EQ(cloud.depth(), expected.depth());
  metres.pop_back();
  EXPECT_THROW(cloud.assign(kSmallCamera, metres, {}, Executor(2)), InputError);
}

}  // namespace
}  // namespace lockbox
