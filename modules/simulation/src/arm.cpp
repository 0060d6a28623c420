// SPDX-License-Identifier: BSD-3-Clause
#include "arm.hpp"

#include <algorithm>
#include <cmath>

#include "lockbox/simulation/trajectory.hpp"

namespace lockbox::simulation {
namespace {

/// The two bones as sides of a triangle over the line from shoulder to wrist.
ArmPosture bent(const SceneArm& arm, const Eigen::Vector3d& shoulder,
                const Eigen::Vector3d& wrist) {
  const Eigen::Vector3d line = wrist - shoulder;
  const double reach = std::clamp(line.norm(), std::abs(arm.upper_arm - arm.forearm) + 1e-6,
                                  arm.upper_arm + arm.forearm);
  const Eigen::Vector3d along = line.norm() > 1e-9 ? line.normalized() : Eigen::Vector3d::UnitX();
  const double foot =
      (reach * reach + arm.upper_arm * arm.upper_arm - arm.forearm * arm.forearm) / (2.0 * reach);
  const double height = std::sqrt(std::max(0.0, arm.upper_arm * arm.upper_arm - foot * foot));
  const Eigen::Vector3d aside = arm.elbow - along.dot(arm.elbow) * along;
  const Eigen::Vector3d out = aside.norm() > 1e-9 ? aside.normalized() : along.unitOrthogonal();
  return {shoulder, shoulder + foot * along + height * out, shoulder + reach * along};
}

}  // namespace

std::optional<ArmPosture> posture(const SceneArm& arm, double time) {
  if (arm.waypoints.empty() || time < arm.waypoints.front().time ||
      time > arm.waypoints.back().time) {
    return std::nullopt;
  }
  const auto next = std::find_if(arm.waypoints.begin() + 1, arm.waypoints.end(),
                                 [time](const ArmWaypoint& w) { return w.time >= time; });
  if (next == arm.waypoints.end()) {
    return bent(arm, arm.waypoints.front().shoulder, arm.waypoints.front().wrist);
  }
  const ArmWaypoint& from = *(next - 1);
  const double progress = smooth_step((time - from.time) / (next->time - from.time));
  return bent(arm, from.shoulder + progress * (next->shoulder - from.shoulder),
              from.wrist + progress * (next->wrist - from.wrist));
}

}  // namespace lockbox::simulation
