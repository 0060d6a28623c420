// SPDX-License-Identifier: BSD-3-Clause
// What is drawn over the whole of a window: sliders, the seek bar, help.
#include <gmock/gmock.h>

#include <algorithm>
#include <tuple>

#include "scene_window_fixture.hpp"

namespace lockbox {
namespace {

using testing::IsEmpty;

using WindowFront = SceneWindowTest;

/// Moves the mouse from one pixel to another with its button down.
void drag(XUser& user, SceneWindow& window, int x, int y, int to) {
  user.point(x, y);
  window.poll();
  user.press_button(x, y);
  window.poll();
  user.point(to, y);
  window.poll();
  user.release_button(to, y);
  window.poll();
}

TEST_F(WindowFront, ReportsWhereSlidersAreMoved) {
  const auto window = open(true);
  DisplayedScene scene = block_at(0.0);
  scene.sliders = {{"one", "%.0f", 0.0, 10.0, 5.0, ""}, {"two", "%.0f", -1.0, 1.0, 0.0, ""}};
  scene.seek_bar = {"", "%.0f", 0.0, 100.0, 50.0, ""};
  window->show(scene);
  user_.find_window(kTitle);
  EXPECT_THAT(window->take_moves(), IsEmpty());

  // The handle of the second slider: the middle of 0.02 to 0.48 of the width, at 0.88 - 0.085 of
  // the height; the seek bar's is in the middle, at 0.06.
  drag(user_, *window, 50, 32, 70);
  auto moves = window->take_moves();
  ASSERT_FALSE(moves.empty());
  EXPECT_EQ(moves.back().slider, 1U);
  EXPECT_GT(moves.back().value, 0.2);
  EXPECT_LT(moves.back().value, 1.0);
  EXPECT_THAT(window->take_moves(), IsEmpty());

  drag(user_, *window, 100, 150, 60);
  moves = window->take_moves();
  ASSERT_FALSE(moves.empty());
  EXPECT_EQ(moves.back().slider, std::nullopt);
  EXPECT_NEAR(moves.back().value, 24.0, 6.0);
}

/// Whether the bar of a slider goes through this column of some rows.
bool has_bar(const RgbImage& image, int u, int top, int bottom) {
  for (int v = top; v <= bottom; ++v) {
    const auto* const color = &image.rgb[3 * static_cast<std::size_t>(v * image.width + u)];
    if (color[0] > 80 && color[2] > color[0] && color[2] < 200) return true;
  }
  return false;
}

TEST_F(WindowFront, SeekBarIsThatOfTheWholeWindowWhereTwoScenesAreShown) {
  WindowOptions options;  // large enough for bars of some pixels
  options.title = kTitle;
  options.width = 800;
  options.height = 400;
  const auto window = open_scene_window({{&block_, {1.0F, 0.0F, 0.0F}, 0}}, options);
  window->look({});
  DisplayedScene scene = block_at(0.0);
  scene.seek_bar = {"", "%.0f", 0.0, 100.0, 50.0, ""};
  for (const bool is_split : {true, false, true}) {
    if (is_split) {
      window->show_beside(scene, block_at(0.0));
    } else {
      window->show(scene);
    }
    const RgbImage image = window->picture();
    for (const int x : {120, 350, 450, 650}) {
      EXPECT_TRUE(has_bar(image, x, 371, 381)) << x;
    }
    EXPECT_FALSE(has_bar(image, 760, 371, 381));
  }
  user_.find_window(kTitle);
  drag(user_, *window, 400, 375, 560);
  const auto moves = window->take_moves();
  ASSERT_FALSE(moves.empty());
  EXPECT_NEAR(moves.back().value, 76.0, 6.0);
}

TEST_F(WindowFront, SlidersAreLabelledAsLargeAsTheDisplayAsks) {
  const auto bright_pixels = [&](double scale) {
    WindowOptions options;
    options.width = 900;
    options.height = 400;
    options.scale = scale;
    const auto window = open_scene_window({{&block_, {1.0F, 0.0F, 0.0F}, 0}}, options);
    DisplayedScene scene;
    scene.sliders = {{"HHHHHHHH", "%.0f", 0.0, 10.0, 5.0, "0 to 10"}};
    window->show(scene);
    const RgbImage image = window->picture();
    return std::count_if(image.rgb.begin(), image.rgb.end(), [](int value) { return value > 150; });
  };
  EXPECT_GT(bright_pixels(2.0), 2 * bright_pixels(1.0));
}

/// Where the pictures differ: the least and the greatest column and row.
struct Extent {
  int left = 10000;
  int right = -1;
  int top = 10000;
  int bottom = -1;
};

Extent difference(const RgbImage& one, const RgbImage& other) {
  Extent extent;
  for (std::size_t i = 0; i < one.rgb.size(); ++i) {
    if (one.rgb[i] == other.rgb[i]) continue;
    const int pixel = static_cast<int>(i / 3);
    extent.left = std::min(extent.left, pixel % one.width);
    extent.right = std::max(extent.right, pixel % one.width);
    extent.top = std::min(extent.top, pixel / one.width);
    extent.bottom = std::max(extent.bottom, pixel / one.width);
  }
  return extent;
}

TEST_F(WindowFront, HelpIsInTheMiddleOfTheWindowAndFitsIntoIt) {
  std::string lines;
  for (int i = 0; i < 17; ++i) lines += "\n  key           what it does, in a line of many words";
  for (const auto& [width, height, scale] :
       {std::tuple(1280, 720, 1.0), std::tuple(1920, 1080, 2.0), std::tuple(320, 200, 3.0)}) {
    WindowOptions options;
    options.visible = false;
    options.width = width;
    options.height = height;
    options.scale = scale;
    const auto window = open_scene_window({{&block_, {1.0F, 0.0F, 0.0F}, 0}}, options);
    for (const bool is_split : {false, true}) {
      const auto draw = [&](const std::string& overlay) {
        DisplayedScene scene;
        scene.overlay = overlay;
        if (is_split) {
          window->show_beside({}, scene);
        } else {
          window->show(scene);
        }
        return window->picture();
      };
      const Extent help = difference(draw(""), draw(lines));
      EXPECT_GE(help.left, 2) << width << ' ' << is_split;
      EXPECT_LE(help.right, width - 3) << width << ' ' << is_split;
      EXPECT_GE(help.top, 2) << width << ' ' << is_split;
      EXPECT_LE(help.bottom, height - 3) << width << ' ' << is_split;
      EXPECT_NEAR(help.left + help.right, width, 8) << is_split;
      EXPECT_NEAR(help.top + help.bottom, height, 8) << is_split;
      EXPECT_GT(help.right - help.left, width / 4) << "no smaller than it must be";
    }
  }
}

}  // namespace
}  // namespace lockbox
