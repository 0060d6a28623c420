// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/rendering/depth_renderer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>

#include "rendered_scene.hpp"
#include "test_scene.hpp"

namespace lockbox {
namespace {

using testing::ball;
using testing::pixel;
using testing::placed;
using testing::rectangle;
using testing::rendered;
using testing::vga_camera;

TEST(DepthRenderer, NothingIsInfinitelyFarAway) {
  const RenderedDepth image = rendered(vga_camera(), {});
  EXPECT_EQ(image.depth.size(), 640U * 480U);
  EXPECT_THAT(image.depth, ::testing::Each(std::numeric_limits<float>::infinity()));
  EXPECT_THAT(image.id, ::testing::Each(kNothing));
}

// The ray of pixel (u, v) is r = ((u - cx) / fx, (v - cy) / fy, 1); it meets the plane n.p = n.p0
// at z = n.p0 / n.r.
TEST(DepthRenderer, TiltedPlaneIsExactAtEveryPixelCentre) {
  const PinholeCamera camera = vga_camera();
  const TriangleMesh plane = rectangle(20.0, 20.0);
  const Eigen::Isometry3d pose = placed({0.1, -0.2, 1.4}, {0.9, -0.3, 0.2});
  const RenderedDepth image = rendered(camera, {{&plane, pose, 3}});
  const Eigen::Vector3d normal = pose.linear().col(2);
  const double offset = normal.dot(pose.translation());
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const double z = offset / normal.dot(camera.back_project(u, v, 1.0));
      const auto i = pixel(camera, u, v);
      ASSERT_EQ(image.id[i], 3) << u << " " << v;
      ASSERT_NEAR(image.depth[i], z, 1e-6 * z) << u << " " << v;
    }
  }
}

TEST(DepthRenderer, BallHasTheDepthAndTheContourOfASphere) {
  const PinholeCamera camera = vga_camera();
  const Eigen::Vector3d centre(0.15, -0.1, 1.2);
  const double radius = 0.3;
  // The faces lie at most radius (1 - cos(pi / 400)) = 0.01 mm inside the sphere, measured along
  // its normal; along the ray that grows with 1 / cos(incidence).
  const double inside = 1e-5;
  const TriangleMesh sphere = ball(radius, 400);
  const RenderedDepth image = rendered(camera, {{&sphere, placed(centre), 0}});
  int seen = 0;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Eigen::Vector3d ray = camera.back_project(u, v, 1.0).normalized();
      const double along = ray.dot(centre);
      const double miss = (centre - along * ray).norm();
      const auto i = pixel(camera, u, v);
      if (miss > radius) {
        EXPECT_EQ(image.id[i], kNothing) << u << " " << v;
      } else if (miss < radius - 2.0 * inside) {
        const double chord = std::sqrt(radius * radius - miss * miss);
        const double z = (along - chord) * ray.z();
        ASSERT_EQ(image.id[i], 0) << u << " " << v;
        EXPECT_NEAR(image.depth[i], z, 2.0 * inside * radius / chord + 1e-6) << u << " " << v;
        ++seen;
      }
    }
  }
  EXPECT_GT(seen, 50000);
}

TEST(DepthRenderer, ThePixelBelongsToTheMeshThatHoldsItsCentre) {
  const PinholeCamera camera{64, 48, 60.0, 60.0, 31.5, 23.5};
  const TriangleMesh square = rectangle(1.0, 1.0);
  // 60 px a metre at z = 1; the square spans [cx - 30, cx + 30] = [1.5, 61.5] horizontally.
  for (const double shift : {-0.49, -0.01, 0.01, 0.49}) {
    const RenderedDepth image = rendered(camera, {{&square, placed({shift / 60.0, 0.0, 1.0}), 0}});
    const auto first = image.id.begin() + 20 * camera.width;
    const auto count = std::count(first, first + camera.width, 0);
    EXPECT_EQ(count, 60) << shift;
    EXPECT_EQ(image.id[pixel(camera, 1, 20)], kNothing);
    EXPECT_EQ(image.id[pixel(camera, 2, 20)], 0);
  }
}

TEST(DepthRenderer, CentresOnASharedEdgeBelongToOneSideOnly) {
  // Columns 8, 16, ... of the image lie exactly on edges between the cells.
  const PinholeCamera camera{65, 65, 64.0, 64.0, 32.0, 32.0};
  const TriangleMesh cell = rectangle(0.125, 0.125);
  std::vector<RenderItem> cells;
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j < 8; ++j) {
      cells.push_back({&cell, placed({-0.4375 + 0.125 * i, -0.4375 + 0.125 * j, 1.0}),
                       static_cast<std::int16_t>(8 * j + i)});
    }
  }
  const RenderedDepth image = rendered(camera, cells);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const bool inside = u < 64 && v < 64;
      const int expected = inside ? 8 * (v / 8) + u / 8 : kNothing;
      ASSERT_EQ(image.id[pixel(camera, u, v)], expected) << u << " " << v;
    }
  }
}

TEST(DepthRenderer, ClosedSurfaceHasNoPinholes) {
  // A wall of random slivers, seen from random directions: every centre inside is covered.
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-0.1, 0.1);
  const std::uint32_t n = 40;
  TriangleMesh wall;
  for (std::uint32_t j = 0; j <= n; ++j) {
    for (std::uint32_t i = 0; i <= n; ++i) {
      wall.vertices.emplace_back(0.1 * i - 2.0 + 0.45 * uniform(random),
                                 0.1 * j - 2.0 + 0.45 * uniform(random), uniform(random));
    }
  }
  for (std::uint32_t j = 0; j < n; ++j) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = j * (n + 1) + i;
      wall.triangles.push_back({a, a + 1, a + n + 2});
      wall.triangles.push_back({a + n + 2, a + n + 1, a});
    }
  }
  for (int view = 0; view < 20; ++view) {
    const Eigen::Vector3d turn(4.0 * uniform(random), 4.0 * uniform(random), uniform(random));
    const RenderedDepth image = rendered(vga_camera(), {{&wall, placed({0.0, 0.0, 1.0}, turn), 0}});
    EXPECT_EQ(std::count(image.id.begin(), image.id.end(), kNothing), 0) << view;
  }
}

TEST(DepthRenderer, NearestSurfaceWinsWhateverTheOrder) {
  const TriangleMesh plane = rectangle(10.0, 10.0);
  const RenderItem near{&plane, placed({0.0, 0.0, 1.0}, {0.3, 0.0, 0.0}), 1};
  const RenderItem far{&plane, placed({0.0, 0.0, 1.0}, {-0.3, 0.0, 0.0}), 2};
  const RenderedDepth one = rendered(vga_camera(), {near, far});
  const RenderedDepth other = rendered(vga_camera(), {far, near});
  EXPECT_EQ(one.depth, other.depth);
  EXPECT_EQ(one.id, other.id);
  EXPECT_EQ(one.id[pixel(vga_camera(), 320, 0)], 1);
  EXPECT_EQ(one.id[pixel(vga_camera(), 320, 479)], 2);
}

TEST(DepthRenderer, EqualDepthsGoToTheEarlierItem) {
  const TriangleMesh plane = rectangle(10.0, 10.0);
  const Eigen::Isometry3d pose = placed({0.0, 0.0, 1.0}, {0.2, 0.1, 0.0});
  EXPECT_THAT(rendered(vga_camera(), {{&plane, pose, 5}, {&plane, pose, 4}}).id,
              ::testing::Each(std::int16_t{5}));
}

/// Spheres and planes that cross one another.
std::vector<RenderItem> crossing_items(const TriangleMesh& sphere, const TriangleMesh& plane) {
  std::vector<RenderItem> items;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-0.5, 0.5);
  for (std::int16_t i = 0; i < 8; ++i) {
    items.push_back(
        {&sphere, placed({uniform(random), uniform(random), 1.5 + uniform(random)}), i});
    items.push_back({&plane, placed({0.0, 0.0, 1.8}, {uniform(random), uniform(random), 0.0}),
                     static_cast<std::int16_t>(100 + i)});
  }
  return items;
}

TEST(DepthRenderer, SameForAnyNumberOfThreads) {
  const TriangleMesh sphere = ball(0.3, 60);
  const TriangleMesh plane = rectangle(4.0, 4.0);
  const std::vector<RenderItem> items = crossing_items(sphere, plane);
  const RenderedDepth reference = rendered(vga_camera(), items, 1);
  for (const int threads : {2, 3, 8}) {
    const RenderedDepth image = rendered(vga_camera(), items, threads);
    EXPECT_EQ(image.depth, reference.depth) << threads;
    EXPECT_EQ(image.id, reference.id) << threads;
  }
}

TEST(DepthRenderer, EveryInstructionSetDrawsTheSame) {
  const TriangleMesh sphere = ball(0.3, 60);
  const TriangleMesh plane = rectangle(4.0, 4.0);
  const std::vector<RenderItem> items = crossing_items(sphere, plane);
  hwy::SetSupportedTargetsForTest(0);
  const std::int64_t supported = hwy::SupportedTargets();
  const RenderedDepth reference = rendered(vga_camera(), items);
  for (std::int64_t rest = supported; rest != 0; rest &= rest - 1) {
    const std::int64_t target = rest & -rest;
    hwy::SetSupportedTargetsForTest(target);
    const RenderedDepth image = rendered(vga_camera(), items);
    EXPECT_EQ(image.id, reference.id) << hwy::TargetName(target);
    EXPECT_THAT(image.depth, ::testing::Pointwise(::testing::FloatNear(1e-6F), reference.depth))
        << hwy::TargetName(target);
  }
  hwy::SetSupportedTargetsForTest(0);
}

TEST(DepthRenderer, FrameDoesNotDependOnTheFrameBefore) {
  const TriangleMesh sphere = ball(0.3, 60);
  const std::vector<RenderItem> one = {{&sphere, placed({0.0, 0.0, 1.0}), 0}};
  const std::vector<RenderItem> two = {{&sphere, placed({0.3, 0.0, 1.0}), 0},
                                       {&sphere, placed({-0.3, 0.1, 1.4}), 1}};
  DepthRenderer renderer(vga_camera(), Executor(2));
  RenderedDepth image;
  renderer.render(two, image);
  renderer.render(one, image);
  const RenderedDepth fresh = rendered(vga_camera(), one);
  EXPECT_EQ(image.depth, fresh.depth);
  EXPECT_EQ(image.id, fresh.id);
}

}  // namespace
}  // namespace lockbox
