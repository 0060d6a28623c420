// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/rendering/depth_renderer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <random>

#include "lockbox/mesh/primitives.hpp"
#include "test_scene.hpp"

namespace lockbox {
namespace {

using testing::ball;
using testing::rectangle;
using testing::vga_camera;

Eigen::Isometry3d placed(const Eigen::Vector3d& position,
                         const Eigen::Vector3d& rotation = Eigen::Vector3d::Zero()) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() = position;
  if (rotation.norm() > 0.0) {
    T.linear() = Eigen::AngleAxisd(rotation.norm(), rotation.normalized()).toRotationMatrix();
  }
  return T;
}

RenderedDepth rendered(const PinholeCamera& camera, const std::vector<RenderItem>& items,
                       int threads = 2) {
  DepthRenderer renderer(camera, Executor(threads));
  RenderedDepth image;
  renderer.render(items, image);
  return image;
}

std::size_t pixel(const PinholeCamera& camera, int u, int v) {
  return static_cast<std::size_t>(v * camera.width + u);
}

TEST(DepthRenderer, DrawsWithTheCameraThatItWasGivenLast) {
  const TriangleMesh mesh = ball(0.2, 60);
  const std::vector<RenderItem> items{{&mesh, placed({0.1, 0.0, 1.0}), 3}};
  const PinholeCamera cut_out{40, 30, 500.0, 500.0, -20.0, 15.0};
  DepthRenderer renderer(vga_camera(), Executor(1));
  RenderedDepth image;
  renderer.render(items, image);
  renderer.set_camera(cut_out);
  renderer.render(items, image);
  const RenderedDepth expected = rendered(cut_out, items);
  EXPECT_EQ(image.width, 40);
  EXPECT_EQ(image.depth, expected.depth);
  EXPECT_EQ(image.id, expected.id);
}

TEST(DepthRenderer, WindowsShowTheSameAsTheWholeImage) {
  const TriangleMesh near_ball = ball(0.2, 60);
  const TriangleMesh wall = rectangle(4.0, 3.0);
  const std::vector<RenderItem> items{{&near_ball, placed({0.1, 0.0, 1.0}), 3},
                                      {&wall, placed({0.0, 0.0, 1.5}, {0.3, 0.2, 0.0}), 5}};
  const RenderedDepth whole = rendered(vga_camera(), items);
  DepthRenderer renderer(vga_camera(), Executor(2));
  renderer.prepare(items);
  RenderedInverseDepth part;
  for (const ImageWindow& window : {ImageWindow{300, 200, 41, 33}, ImageWindow{0, 0, 640, 480},
                                    ImageWindow{609, 463, 31, 17}, ImageWindow{7, 430, 1, 50}}) {
    renderer.draw(window, part);
    ASSERT_EQ(part.width, window.width);
    ASSERT_EQ(part.height, window.height);
    for (int v = 0; v < window.height; ++v) {
      for (int u = 0; u < window.width; ++u) {
        const std::size_t i = whole.index(window.left + u, window.top + v);
        const auto at = static_cast<std::size_t>(v * window.width + u);
        ASSERT_EQ(part.id[at], whole.id[i]) << u << ' ' << v;
        const float expected = 1.0F / whole.depth[i];
        ASSERT_NEAR(part.inverse_depth[at], expected, 1e-6F * expected) << u << ' ' << v;
      }
    }
  }
}

/// The columns and rows of what an image shows.
ImageWindow shown(const RenderedDepth& image) {
  ImageWindow window{image.width, image.height, 0, 0};
  int right = 0;
  int bottom = 0;
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u) {
      if (image.id[image.index(u, v)] == kNothing) continue;
      window.left = std::min(window.left, u);
      window.top = std::min(window.top, v);
      right = std::max(right, u + 1);
      bottom = std::max(bottom, v + 1);
    }
  }
  window.width = right - window.left;
  window.height = bottom - window.top;
  return window;
}

TEST(DepthRenderer, TellsWhereSomethingIsDrawn) {
  const TriangleMesh left = ball(0.1, 60);
  const TriangleMesh right = ball(0.05, 60);
  const std::vector<RenderItem> items{{&left, placed({-0.3, 0.1, 1.0}), 3},
                                      {&right, placed({0.1, -0.2, 1.2}), 5}};
  const RenderedDepth image = rendered(vga_camera(), items);
  const ImageWindow expected = shown(image);
  // Triangles may end between the centres of pixels.
  EXPECT_NEAR(image.drawn.left, expected.left, 1);
  EXPECT_NEAR(image.drawn.top, expected.top, 1);
  EXPECT_NEAR(image.drawn.right(), expected.right(), 1);
  EXPECT_NEAR(image.drawn.bottom(), expected.bottom(), 1);
  EXPECT_LE(image.drawn.left, expected.left);
  EXPECT_LE(image.drawn.top, expected.top);
  EXPECT_GE(image.drawn.right(), expected.right());
  EXPECT_GE(image.drawn.bottom(), expected.bottom());
}

TEST(DepthRenderer, DrawnIsOnlyWhatTheImageHolds) {
  const TriangleMesh wall = rectangle(40.0, 30.0);
  const RenderedDepth image = rendered(vga_camera(), {{&wall, placed({0.0, 0.0, 1.5}), 5}});
  EXPECT_EQ(image.drawn.left, 0);
  EXPECT_EQ(image.drawn.top, 0);
  EXPECT_EQ(image.drawn.width, 640);
  EXPECT_EQ(image.drawn.height, 480);
  const RenderedDepth beside = rendered(vga_camera(), {{&wall, placed({60.0, 0.0, 1.5}), 5}});
  EXPECT_EQ(beside.drawn.width, 0);
  EXPECT_EQ(rendered(vga_camera(), {}).drawn.width, 0);
}

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

TEST(DepthRenderer, BallHasTheDepthAndTheOutlineOfASphere) {
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

TEST(DepthRenderer, BothFacesAreDrawn) {
  const TriangleMesh plane = rectangle(10.0, 10.0);
  EXPECT_THAT(rendered(vga_camera(), {{&plane, placed({0.0, 0.0, 1.0}), 0}}).id,
              ::testing::Each(std::int16_t{0}));
  EXPECT_THAT(
      rendered(vga_camera(), {{&plane, placed({0.0, 0.0, 1.0}, {std::numbers::pi, 0.0, 0.0}), 0}})
          .id,
      ::testing::Each(std::int16_t{0}));
}

TEST(DepthRenderer, BacksOfASolidAreLeftOut) {
  // Only the claim that the plane bounds a solid makes it vanish from behind.
  const TriangleMesh plane = rectangle(10.0, 10.0);
  const Eigen::Isometry3d from_behind = placed({0.0, 0.0, 1.0});
  const Eigen::Isometry3d from_the_front = placed({0.0, 0.0, 1.0}, {std::numbers::pi, 0.0, 0.0});
  EXPECT_THAT(rendered(vga_camera(), {{&plane, from_behind, 0, true}}).id,
              ::testing::Each(kNothing));
  EXPECT_THAT(rendered(vga_camera(), {{&plane, from_the_front, 0, true}}).id,
              ::testing::Each(std::int16_t{0}));
}

TEST(DepthRenderer, SolidLooksTheSameWithoutItsBacks) {
  const TriangleMesh sphere = ball(0.3, 60);
  TriangleMesh box = make_box({0.4, 0.3, 0.2});
  append(box, transformed(make_box({0.1, 0.5, 0.1}), placed({0.05, 0.0, 0.05})));
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-0.5, 0.5);
  for (int view = 0; view < 10; ++view) {
    const Eigen::Vector3d turn(6.0 * uniform(random), 6.0 * uniform(random), uniform(random));
    const Eigen::Vector3d place(uniform(random), uniform(random), 0.8 + uniform(random));
    std::vector<RenderItem> items = {{&sphere, placed({0.2, 0.0, 1.0}), 0},
                                     {&box, placed(place, turn), 1}};
    const RenderedDepth both = rendered(vga_camera(), items);
    for (RenderItem& item : items) {
      item.encloses_solid = true;
    }
    const RenderedDepth fronts = rendered(vga_camera(), items);
    EXPECT_EQ(fronts.depth, both.depth) << view;
    EXPECT_EQ(fronts.id, both.id) << view;
  }
}

TEST(DepthRenderer, SolidThatTheNearPlaneCutsOpenShowsItsBacks) {
  const TriangleMesh room = make_box({4.0, 3.0, 5.0});
  const RenderedDepth inside = rendered(vga_camera(), {{&room, placed({0.0, 0.0, 0.0}), 0, true}});
  EXPECT_THAT(inside.id, ::testing::Each(std::int16_t{0}));
  EXPECT_FLOAT_EQ(inside.depth[pixel(vga_camera(), 320, 240)], 2.5F);
}

TEST(DepthRenderer, SurfaceThroughTheCameraIsCutAtTheNearPlane) {
  const PinholeCamera camera = vga_camera();
  // The floor, half a metre below the camera, from far behind it to far before it.
  const TriangleMesh plane = rectangle(100.0, 100.0);
  const RenderedDepth image =
      rendered(camera, {{&plane, placed({0.0, 0.5, 0.0}, {0.5 * std::numbers::pi, 0.0, 0.0}), 0}});
  for (int v = 0; v < camera.height; ++v) {
    const double z = v > camera.cy ? 0.5 * camera.fy / (v - camera.cy) : 0.0;
    const bool seen = z > 0.0 && z < 50.0;
    const auto i = pixel(camera, 100, v);
    ASSERT_EQ(image.id[i], seen ? 0 : kNothing) << v;
    if (seen) {
      ASSERT_NEAR(image.depth[i], z, 1e-6 * z) << v;
    }
  }
}

TEST(DepthRenderer, SurfaceBehindTheCameraIsNotSeen) {
  const TriangleMesh plane = rectangle(10.0, 10.0);
  EXPECT_THAT(rendered(vga_camera(), {{&plane, placed({0.0, 0.0, -1.0}), 0}}).id,
              ::testing::Each(kNothing));
}

TEST(DepthRenderer, PoseThatIsNotANumberDrawsNothing) {
  const TriangleMesh plane = rectangle(10.0, 10.0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Eigen::Vector3d& p : {Eigen::Vector3d(nan, 0.0, 1.0), Eigen::Vector3d(0.0, nan, 1.0),
                                   Eigen::Vector3d(0.0, 0.0, nan)}) {
    EXPECT_THAT(rendered(vga_camera(), {{&plane, placed(p), 0}}).id, ::testing::Each(kNothing));
  }
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
