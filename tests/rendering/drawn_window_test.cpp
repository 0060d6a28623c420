// SPDX-License-Identifier: BSD-3-Clause
// Parts of an image, and which part shows something.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "rendered_scene.hpp"
#include "test_scene.hpp"

namespace lockbox {
namespace {

using testing::ball;
using testing::placed;
using testing::rectangle;
using testing::rendered;
using testing::vga_camera;

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

}  // namespace
}  // namespace lockbox
