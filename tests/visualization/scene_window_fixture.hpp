// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gmock/gmock.h>

#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "lockbox/mesh/primitives.hpp"
#include "lockbox/visualization/scene_window.hpp"
#include "x_user.hpp"

namespace lockbox {

/// A red block half a metre from the camera, which looks at it along z.
class SceneWindowTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!user_.is_connected()) GTEST_SKIP() << "no display";
  }

  std::unique_ptr<SceneWindow> open(bool visible) const {
    WindowOptions options;
    options.title = kTitle;
    options.width = 200;
    options.height = 160;
    options.visible = visible;
    auto window = open_scene_window({{&block_, {1.0F, 0.0F, 0.0F}, 0}}, options);
    window->look({});
    return window;
  }

  static DisplayedScene block_at(double x) {
    DisplayedScene scene;
    scene.T_camera_body = {Eigen::Isometry3d(Eigen::Translation3d(x, 0.0, 0.5))};
    return scene;
  }

  static std::vector<int> color_at(const RgbImage& image, int u, int v) {
    const auto first = image.rgb.begin() + std::ptrdiff_t{3} * (v * image.width + u);
    return {first, first + 3};
  }

  static bool is_red(const RgbImage& image, int u, int v) {
    const auto color = color_at(image, u, v);
    return color[0] > 100 && color[1] < 20 && color[2] < 20;
  }

  /// What the window reports within a while.
  static std::vector<std::string> keys_of(SceneWindow& window, std::size_t count) {
    std::vector<std::string> keys;
    for (int waits = 0; waits < 5000 && keys.size() < count && window.is_open(); ++waits) {
      for (const auto& key : window.poll()) keys.push_back(key);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return keys;
  }

  static constexpr char kTitle[] = "scene window test";
  const TriangleMesh block_ = make_box({0.1, 0.1, 0.1});
  XUser user_;
};

}  // namespace lockbox
