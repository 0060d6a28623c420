// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/simulation/scene_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "lockbox/model/model_bounds.hpp"

namespace lockbox {
namespace {

/// The first of the axes that points farthest along the direction.
template <std::size_t Count>
Eigen::Vector3d best_along(const Eigen::Vector3d& direction,
                           const std::array<Eigen::Vector3d, Count>& axes) {
  return *std::max_element(axes.begin(), axes.end(), [&](const auto& a, const auto& b) {
    return a.dot(direction) < b.dot(direction);
  });
}

/// Columns: what is right, up and to the front, in the model's base frame.
Eigen::Matrix3d upright_frame(const Eigen::Isometry3d& T_camera_base) {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  const Eigen::Vector3d y = Eigen::Vector3d::UnitY();
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  const Eigen::Matrix3d R_base_camera = T_camera_base.linear().transpose();
  const Eigen::Vector3d image_up = R_base_camera * -y;
  const Eigen::Vector3d to_camera = R_base_camera * -T_camera_base.translation();
  const Eigen::Vector3d up = best_along<4>(image_up, {y, z, -y, -z});
  const Eigen::Vector3d level = std::abs(up.y()) > 0.5 ? z : y;
  const Eigen::Vector3d front = best_along<4>(to_camera, {level, x, -x, -level});
  Eigen::Matrix3d frame;
  frame << up.cross(front), up, front;
  return frame;
}

/// Moves what lies beyond faces of the room out with them.
void move_out(const Eigen::AlignedBox3d& room, const Eigen::Vector3d& by_lower,
              const Eigen::Vector3d& by_upper, Eigen::Vector3d& centre) {
  for (int axis = 0; axis < 3; ++axis) {
    if (centre[axis] < room.min()[axis]) centre[axis] -= by_lower[axis];
    if (centre[axis] > room.max()[axis]) centre[axis] += by_upper[axis];
  }
}

}  // namespace

Scene fitted(const Scene& scene, const KinematicTree& tree, const State& first) {
  Scene fit = scene;
  if (!scene.room) return fit;
  fit.R_base_scene = upright_frame(first.configuration.T_camera_base);
  const Eigen::Isometry3d T_scene_base(fit.R_base_scene.transpose());
  const Eigen::AlignedBox3d model =
      model_bounds(tree, first.configuration).transformed(T_scene_base);
  const Eigen::Vector3d by_lower = (scene.room->min() - model.min()).cwiseMax(0.0);
  const Eigen::Vector3d by_upper = (model.max() - scene.room->max()).cwiseMax(0.0);
  const auto move = [&](Eigen::Vector3d& centre) {
    move_out(*scene.room, by_lower, by_upper, centre);
  };
  for (ScenePlane& plane : fit.planes) {
    if (plane.frame == SceneFrame::base) move(plane.point);
  }
  for (SceneBox& box : fit.boxes) {
    Eigen::Vector3d centre = box.pose.translation();
    if (box.frame == SceneFrame::base) move(centre);
    box.pose.translation() = centre;
  }
  for (SceneArm& arm : fit.arms) {
    if (arm.frame != SceneFrame::base) continue;
    for (ArmWaypoint& waypoint : arm.waypoints) {
      waypoint.shoulder.z() += by_upper.z();
      waypoint.wrist.z() += by_upper.z();
    }
  }
  return fit;
}

}  // namespace lockbox
