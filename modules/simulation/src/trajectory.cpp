// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/simulation/trajectory.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "joint_schedule.hpp"
#include "lockbox/core/lie.hpp"
#include "lockbox/core/units.hpp"
#include "lockbox/model/model_bounds.hpp"

namespace lockbox {
namespace {

/// T_start_camera: six slow oscillations of unequal frequency, at rest in the beginning.
Eigen::Isometry3d camera_motion(double time, const TrajectoryOptions& options) {
  const std::array<double, 6> hertz = {0.23, 0.17, 0.13, 0.19, 0.29, 0.11};
  Twist xi;
  for (int i = 0; i < 6; ++i) {
    const double amplitude = i < 3 ? options.sway : options.turn;
    xi[i] = amplitude * smooth_step(time) *
            std::sin(kFullTurn * hertz[static_cast<std::size_t>(i)] * time);
  }
  return exp_se3(xi);
}

}  // namespace

double smooth_step(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * t * (10.0 + t * (-15.0 + t * 6.0));
}

Eigen::Isometry3d facing_pose(double distance) {
  Eigen::Isometry3d T_camera_base = Eigen::Isometry3d::Identity();
  T_camera_base.linear().diagonal() << 1.0, -1.0, -1.0;
  T_camera_base.translation().z() = distance;
  return T_camera_base;
}

double viewing_distance(const KinematicTree& tree, const PinholeCamera& camera) {
  constexpr double kUsual = 1.3;      // metres
  constexpr double kNearest = 0.5;    // metres
  constexpr double kMargin = 1.1;     // of the model's height, or width, for the camera to sway in
  constexpr double kDiagonals = 4.5;  // of the model's box: from farther away it is some 100 pixels
  const Eigen::Vector3d size = model_bounds(tree, rest_configuration(tree)).sizes();
  const double to_see_all =
      kMargin * std::max(size.x() * camera.fx / camera.width, size.y() * camera.fy / camera.height);
  const double to_see_enough = std::max(kNearest, kDiagonals * size.norm());
  return std::max(to_see_all, std::min(kUsual, to_see_enough));
}

std::vector<State> generate_trajectory(const KinematicTree& tree,
                                       const TrajectoryOptions& options) {
  const JointSchedule schedule(tree, options);
  std::vector<State> states;
  for (int frame = 0; frame < options.frames; ++frame) {
    State state;
    state.stamp = frame / options.rate;
    state.configuration.T_camera_base =
        camera_motion(state.stamp, options).inverse() * options.T_camera_base;
    state.configuration.q =
        schedule.positions(options.frames > 1 ? frame / (options.frames - 1.0) : 0.0);
    states.push_back(std::move(state));
  }
  return states;
}

}  // namespace lockbox
