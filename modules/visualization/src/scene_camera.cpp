// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "lockbox/visualization/scene_composer.hpp"
#include "lockbox/visualization/viewpoint.hpp"

namespace lockbox {
namespace {

/// The median of the measured depths, metres; 1 if nothing was measured.
double median_depth(const DepthFrame& frame) {
  std::vector<std::uint16_t> measured;
  std::copy_if(frame.depth.begin(), frame.depth.end(), std::back_inserter(measured),
               [](std::uint16_t depth) { return depth != 0; });
  if (measured.empty()) return 1.0;
  const auto middle = measured.begin() + static_cast<std::ptrdiff_t>(measured.size() / 2);
  std::nth_element(measured.begin(), middle, measured.end());
  return static_cast<double>(*middle) * static_cast<double>(frame.metres_per_unit);
}

}  // namespace

SceneCamera camera_near_sensor(const DepthFrame& frame) {
  const double distance = median_depth(frame);
  SceneCamera camera;
  camera.target = {0.0, 0.0, distance};
  camera.eye = Eigen::Vector3d(0.28, -0.24, -0.12) * distance;
  camera.view_angle = 2.0 * std::atan(0.5 * frame.camera.height / frame.camera.fy);
  return camera;
}

SceneCamera camera_before_model(const KinematicTree& tree, const Configuration& configuration) {
  constexpr int kSize = 1000;  // any: the view angle does not depend on it
  const Viewpoint view = overview(tree, configuration, kSize, kSize);
  const Eigen::Isometry3d T_camera_view =
      configuration.T_camera_base * view.T_camera_base.inverse();
  SceneCamera camera;
  camera.eye = T_camera_view.translation();
  camera.target = T_camera_view * Eigen::Vector3d::UnitZ();
  camera.up = T_camera_view.linear() * -Eigen::Vector3d::UnitY();
  camera.view_angle = 2.0 * std::atan(0.5 * kSize / view.camera.fy);
  return camera;
}

}  // namespace lockbox
