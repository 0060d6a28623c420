// SPDX-License-Identifier: BSD-3-Clause
// Runs of states to simulate: every joint through its range, the camera held by a gentle hand.
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <vector>

#include "lockbox/core/pinhole_camera.hpp"
#include "lockbox/core/units.hpp"
#include "lockbox/model/states_file.hpp"

namespace lockbox {

/// Returns the pose of a base that stands upright in front of the camera, its z axis towards it:
/// distance in metres.
Eigen::Isometry3d facing_pose(double distance);

/// Returns the distance, metres, from which such a camera sees all of a model that faces it, and
/// enough of it: 1.3 m of what is some decimetres to a metre across, nearer what is smaller, but
/// for half a metre, which every depth sensor reaches.
double viewing_distance(const KinematicTree& tree, const PinholeCamera& camera);

/// How a trajectory is made.
struct TrajectoryOptions {
  int frames = 300;                                    ///< how many states
  double rate = 30.0;                                  ///< frames a second
  Eigen::Isometry3d T_camera_base = facing_pose(1.3);  ///< of the first frame
  double sway = 0.03;                                  ///< of the camera along each axis, metres
  double turn = 2.0 * kRadians;                        ///< about each axis, radians
  double coverage = 0.9;  ///< share of its range that each joint passes; continuous: of a turn

  /// Whether the joints can stand so, parts not passing through each other; none: always.
  std::function<bool(const Configuration&)> is_possible = nullptr;
};

/// Starts and ends with all joints at rest_configuration and all velocities zero. Each joint goes
/// to the far end of its range, then to the other, and back, at times of its own; it waits where
/// the way is not possible.
std::vector<State> generate_trajectory(const KinematicTree& tree,
                                       const TrajectoryOptions& options = {});

/// Returns 0 at 0, 1 at 1, and the same beyond. It is smooth, with velocity and acceleration zero
/// at both (the minimum-jerk polynomial).
double smooth_step(double x);

}  // namespace lockbox
