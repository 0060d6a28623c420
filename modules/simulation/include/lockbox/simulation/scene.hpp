// SPDX-License-Identifier: BSD-3-Clause
// What stands around the model, and what passes in front of it.
//
// Scenes are written for two frames: `world`, the camera's frame at the first state (x right,
// y down, z forward), and `base`, the model's base frame at the first state. Metres.
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <optional>
#include <vector>

namespace lockbox {

enum class SceneFrame { world, base };

/// What is taken to move when the model's base moves in the camera's frame.
enum class Moving {
  object,  ///< the model: the scene stays where it is in the camera's frame
  camera   ///< the camera: the scene moves along with the model's base
};

/// A rectangle, seen from both sides.
struct ScenePlane {
  SceneFrame frame = SceneFrame::world;               ///< that point and normal are in
  Eigen::Vector3d point = Eigen::Vector3d::UnitZ();   ///< its centre
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< of any length but 0
  Eigen::Vector2d extent{20.0, 20.0};  ///< edge lengths: level (normal to the frame's y), across
};

/// A solid box.
struct SceneBox {
  SceneFrame frame = SceneFrame::world;                    ///< that the pose is in
  Eigen::Vector3d size = Eigen::Vector3d::Ones();          ///< edge lengths, metres
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< of its centre
};

/// Where an arm is at one time.
struct ArmWaypoint {
  double time = 0.0;                                   ///< share of the run, 0 to 1
  Eigen::Vector3d shoulder = Eigen::Vector3d::Zero();  ///< metres, frame of the arm
  Eigen::Vector3d wrist = Eigen::Vector3d::Zero();     ///< metres, frame of the arm
};

/// A person's arm: capsules from shoulder to elbow, to wrist, and on to the finger tips. It is
/// there from the first waypoint's time to the last one's, and comes to rest at each.
struct SceneArm {
  SceneFrame frame = SceneFrame::base;               ///< that the waypoints are in
  double upper_arm = 0.30;                           ///< lengths, metres
  double forearm = 0.26;                             ///< from elbow to wrist
  double hand = 0.18;                                ///< from wrist to finger tips
  double radius = 0.05;                              ///< of all capsules
  Eigen::Vector3d elbow = Eigen::Vector3d::UnitY();  ///< the direction in which the elbow points
  Eigen::Vector3d torso = Eigen::Vector3d::Zero();   ///< from the shoulder to the torso's other end
  double torso_radius = 0.0;                         ///< 0: no torso
  std::vector<ArmWaypoint> waypoints;                ///< in the order of their times
};

/// What there is beside the model.
struct Scene {
  Moving moving = Moving::object;  ///< what stays where it is
  /// The box that it leaves to the model, in its base frame, which `fitted` sees to
  /// (scene_fit.hpp).
  std::optional<Eigen::AlignedBox3d> room;
  /// Where its base frame lies in the model's, turned by `fitted`.
  Eigen::Matrix3d R_base_scene = Eigen::Matrix3d::Identity();
  std::vector<ScenePlane> planes;  ///< walls, tables
  std::vector<SceneBox> boxes;     ///< furniture, occluders
  std::vector<SceneArm> arms;      ///< of people who reach in
};

/// Reads a scene file; its keys are the names of the members above, `quaternion` (qx, qy, qz, qw)
/// and `position` those of a pose, `lower` and `upper` those of the room. Throws InputError with
/// file and line.
Scene read_scene(const std::filesystem::path& file);

}  // namespace lockbox
