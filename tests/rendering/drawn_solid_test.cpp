// SPDX-License-Identifier: BSD-3-Clause
// Fronts, backs, and what the near plane cuts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <random>

#include "lockbox/mesh/primitives.hpp"
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

}  // namespace
}  // namespace lockbox
