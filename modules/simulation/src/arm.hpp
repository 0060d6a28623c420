// SPDX-License-Identifier: BSD-3-Clause
// How an arm stands at a moment.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "lockbox/simulation/scene.hpp"

namespace lockbox::simulation {

/// Points of an arm, in the frame of its waypoints.
struct ArmPosture {
  Eigen::Vector3d shoulder;
  Eigen::Vector3d elbow;
  Eigen::Vector3d wrist;
};

/// Nothing before the first waypoint and after the last. A wrist out of reach stays at the arm's
/// length from the shoulder.
std::optional<ArmPosture> posture(const SceneArm& arm, double time);

}  // namespace lockbox::simulation
