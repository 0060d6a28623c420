// SPDX-License-Identifier: BSD-3-Clause
// Windows of VTK on a real (virtual) X display.
#include "lockbox/visualization/scene_window.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <thread>

#include "lockbox/core/error.hpp"
#include "scene_window_fixture.hpp"

namespace lockbox {
namespace {

using testing::ContainsRegex;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

TEST_F(SceneWindowTest, DrawsTheModelWhereItIs) {
  const auto window = open(false);
  window->show(block_at(0.0));
  EXPECT_TRUE(is_red(window->picture(), 100, 80));
  EXPECT_FALSE(is_red(window->picture(), 160, 80));
  window->show(block_at(0.15));  // the camera's x axis points to the right
  EXPECT_FALSE(is_red(window->picture(), 100, 80));
  EXPECT_TRUE(is_red(window->picture(), 160, 80));
}

TEST_F(SceneWindowTest, HidesTheModelWithoutPoses) {
  const auto window = open(false);
  EXPECT_FALSE(is_red(window->picture(), 100, 80)) << "before the first scene: it is not known";
  window->show(block_at(0.0));
  window->show({});
  EXPECT_FALSE(is_red(window->picture(), 100, 80));
}

TEST_F(SceneWindowTest, DrawsPointsInTheirColorsBeforeAndBehindTheModel) {
  const auto window = open(false);
  DisplayedScene scene = block_at(0.0);
  scene.point_size = 9.0;
  scene.points = {{0.0F, 0.0F, 0.4F}, {0.03F, 0.0F, 0.6F}, {0.0F, -0.1F, 0.4F}};
  scene.point_rgb = {10, 200, 30, 10, 200, 30, 20, 30, 220};
  window->show(scene);
  const RgbImage image = window->picture();
  EXPECT_THAT(color_at(image, 100, 80), ElementsAre(10, 200, 30)) << "in front";
  EXPECT_TRUE(is_red(image, 109, 80)) << "what is behind is hidden";
  // 0.1 m above the axis, 0.4 m away; half the height of 160 pixels is seen under 0.4 rad: 47.3.
  EXPECT_THAT(color_at(image, 100, 80 - 47), ElementsAre(20, 30, 220)) << "y points down";
}

TEST_F(SceneWindowTest, TakesPointsOfAnyNumber) {
  const auto window = open(false);
  DisplayedScene scene;
  for (const std::size_t count : {3U, 0U, 1000U, 1U}) {
    scene.points.assign(count, {0.0F, 0.0F, 0.4F});
    scene.point_rgb.assign(3 * count, 255);
    scene.point_size = 5.0;
    window->show(scene);
    EXPECT_EQ(color_at(window->picture(), 100, 80) == std::vector<int>({255, 255, 255}), count > 0);
  }
}

TEST_F(SceneWindowTest, DrawsTwoScenesSideBySide) {
  const auto window = open(false);
  window->show_beside(block_at(0.0), {});
  EXPECT_TRUE(is_red(window->picture(), 50, 80));
  EXPECT_FALSE(is_red(window->picture(), 150, 80));
  window->show_beside({}, block_at(0.0));
  EXPECT_FALSE(is_red(window->picture(), 50, 80));
  EXPECT_TRUE(is_red(window->picture(), 150, 80));
  window->show(block_at(0.0));
  EXPECT_TRUE(is_red(window->picture(), 100, 80)) << "and one again";
  EXPECT_FALSE(is_red(window->picture(), 150, 80));
}

TEST_F(SceneWindowTest, DrawsTheModelElsewhereInOneColorThatLetsThrough) {
  const auto window = open(false);
  DisplayedScene scene = block_at(-0.1);
  scene.ghosts.push_back({block_at(0.1).T_camera_body, {0.0F, 1.0F, 0.0F}});
  window->show(scene);
  const auto ghost = color_at(window->picture(), 150, 80);
  EXPECT_GT(ghost[1], ghost[0] + 20);
  EXPECT_LT(ghost[1], 200) << "the background shows through";
  EXPECT_TRUE(is_red(window->picture(), 50, 80));
  window->show(block_at(-0.1));
  const auto background = color_at(window->picture(), 150, 80);
  EXPECT_LT(background[1], background[0] + 20) << "gone with the next scene";
}

TEST_F(SceneWindowTest, DrawsPartsInTheColoursOfTheirVertices) {
  const auto window = open(false);
  DisplayedScene scene = block_at(0.0);
  for (std::size_t i = 0; i < block_.vertices.size(); ++i) {
    scene.part_rgb.resize(1);
    for (const int channel : {0, 200, 0}) {
      scene.part_rgb[0].push_back(static_cast<std::uint8_t>(channel));
    }
  }
  window->show(scene);
  EXPECT_THAT(color_at(window->picture(), 100, 80), ElementsAre(0, testing::Gt(90), 0));
  window->show(block_at(0.0));
  EXPECT_TRUE(is_red(window->picture(), 100, 80)) << "its own again";
}

/// Bright pixels of a line of text in a window that is otherwise dark.
std::ptrdiff_t text_pixels(SceneWindow& window) {
  DisplayedScene scene;
  scene.status = "HHHHHHHH";
  window.show(scene);
  const RgbImage image = window.picture();
  return std::count_if(image.rgb.begin(), image.rgb.end(), [](int value) { return value > 150; });
}

TEST_F(SceneWindowTest, WritesAsLargeAsTheDisplayAsks) {
  WindowOptions options;
  options.width = 400;
  options.height = 300;
  const auto pixels_at = [&](double scale) {
    options.scale = scale;
    return text_pixels(*open_scene_window({{&block_, {1.0F, 0.0F, 0.0F}, 0}}, options));
  };
  const auto usual = pixels_at(0.0);
  EXPECT_EQ(usual, pixels_at(1.0)) << "the display asks for nothing";
  EXPECT_GT(pixels_at(2.0), 2 * usual);
  user_.set_resources("Xft.dpi:\t192\n");
  EXPECT_GT(pixels_at(0.0), 2 * usual);
  user_.set_resources("");
}

TEST_F(SceneWindowTest, FitsOnTheScreen) {
  user_.set_resources("Xft.dpi:\t288\n");
  const auto window = open_scene_window({{&block_, {1.0F, 0.0F, 0.0F}, 0}}, {});
  user_.set_resources("");
  const auto [width, height] = user_.screen_size();
  const RgbImage image = window->picture();
  EXPECT_EQ(image.width, std::min(width, 3 * 1280));
  EXPECT_EQ(image.height, std::min(height, 3 * 800));
}

TEST_F(SceneWindowTest, ReportsKeysByName) {
  const auto window = open(true);
  window->show(block_at(0.0));
  user_.find_window(kTitle);
  for (const auto* key : {"space", "Left", "e"}) user_.press(key);
  EXPECT_THAT(keys_of(*window, 3), ElementsAre("space", "Left", "e"));
  EXPECT_TRUE(window->is_open());
}

TEST_F(SceneWindowTest, TellsItsFrameRateInTheTitleWhileItMoves) {
  const auto window = open(true);
  window->show(block_at(0.0));
  user_.find_window(kTitle);
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (user_.title() == kTitle && std::chrono::steady_clock::now() < give_up) {
    window->show(block_at(0.0));
    window->poll();
  }
  EXPECT_THAT(user_.title(), ContainsRegex("^scene window test - [0-9.]+ frames/s$"));
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  window->poll();
  EXPECT_EQ(user_.title(), kTitle);
}

TEST_F(SceneWindowTest, IsClosedByTheUser) {
  for (const bool by_key : {true, false}) {
    const auto window = open(true);
    window->show(block_at(0.0));
    user_.find_window(kTitle);
    if (by_key) {
      user_.press("q");
    } else {
      user_.close();
    }
    EXPECT_THAT(keys_of(*window, 1), ElementsAre());
    EXPECT_FALSE(window->is_open()) << (by_key ? "by key" : "by its frame");
  }
}

TEST_F(SceneWindowTest, NeedsADisplayOnlyWhereItIsSeen) {
  const std::string display = std::getenv("DISPLAY");
  const auto open_on = [&](const char* name) {
    ::setenv("DISPLAY", name, 1);
    open(true);
  };
  EXPECT_THAT([&] { open_on(""); }, ThrowsMessage<InputError>(HasSubstr("DISPLAY is not set")));
  EXPECT_THAT([&] { open_on(":4095"); },
              ThrowsMessage<InputError>(HasSubstr("display :4095 cannot be reached")));
  ::unsetenv("DISPLAY");
  const auto picture = open(false);
  picture->show(block_at(0.0));
  EXPECT_TRUE(is_red(picture->picture(), 100, 80));
  ::setenv("DISPLAY", display.c_str(), 1);
}

}  // namespace
}  // namespace lockbox
