// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/simulation/placed_scene.hpp"

#include "arm.hpp"
#include "lockbox/mesh/primitives.hpp"
#include "scene_meshes.hpp"

namespace lockbox {
namespace {

using simulation::make_capsule;

/// Something that does not move in the world.
struct Fixture {
  TriangleMesh mesh;
  Eigen::Isometry3d T_world_mesh;
};

struct Arm {
  SceneArm description;
  Eigen::Isometry3d T_world_frame;
  TriangleMesh upper_arm;
  TriangleMesh forearm_and_hand;
  TriangleMesh torso;

  explicit Arm(const SceneArm& arm, const Eigen::Isometry3d& frame)
      : description(arm),
        T_world_frame(frame),
        upper_arm(make_capsule(arm.upper_arm, arm.radius)),
        forearm_and_hand(make_capsule(arm.forearm + arm.hand - arm.radius, arm.radius)) {
    if (arm.torso_radius > 0.0) {
      torso = make_capsule(arm.torso.norm(), arm.torso_radius);
    }
  }
};

Eigen::Isometry3d pose_along(const Eigen::Vector3d& from, const Eigen::Vector3d& direction) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() = from;
  if (direction.norm() > 0.0) {
    T.linear() = simulation::rotation_along(direction);
  }
  return T;
}

}  // namespace

struct PlacedScene::Geometry {
  Moving moving;
  Eigen::Isometry3d T_world_base;   ///< at the first state
  Eigen::Isometry3d T_world_scene;  ///< of the scene's base frame
  double begin;                     ///< seconds
  double duration;
  std::vector<Fixture> fixtures;
  std::vector<Arm> arms;

  Geometry(const Scene& scene, const std::vector<State>& run);
  Eigen::Isometry3d T_world_frame(SceneFrame frame) const {
    return frame == SceneFrame::base ? T_world_scene : Eigen::Isometry3d::Identity();
  }
  void append_arm(const Arm& arm, double time, const Eigen::Isometry3d& T_camera_world,
                  std::vector<RenderItem>& items) const;
};

PlacedScene::Geometry::Geometry(const Scene& scene, const std::vector<State>& run)
    : moving(scene.moving),
      T_world_base(run.front().configuration.T_camera_base),
      T_world_scene(T_world_base * Eigen::Isometry3d(scene.R_base_scene)),
      begin(run.front().stamp),
      duration(run.back().stamp - run.front().stamp) {
  for (const ScenePlane& plane : scene.planes) {
    fixtures.push_back({simulation::make_rectangle(plane.extent),
                        T_world_frame(plane.frame) * pose_along(plane.point, plane.normal)});
  }
  for (const SceneBox& box : scene.boxes) {
    fixtures.push_back({make_box(box.size), T_world_frame(box.frame) * box.pose});
  }
  for (const SceneArm& arm : scene.arms) {
    arms.emplace_back(arm, T_world_frame(arm.frame));
  }
}

void PlacedScene::Geometry::append_arm(const Arm& arm, double time,
                                       const Eigen::Isometry3d& T_camera_world,
                                       std::vector<RenderItem>& items) const {
  const auto posture = simulation::posture(arm.description, time);
  if (!posture) {
    return;
  }
  const auto append = [&](const TriangleMesh& mesh, const Eigen::Vector3d& from,
                          const Eigen::Vector3d& direction) {
    items.push_back(
        {&mesh, T_camera_world * arm.T_world_frame * pose_along(from, direction), kOccluderId});
  };
  append(arm.upper_arm, posture->shoulder, posture->elbow - posture->shoulder);
  append(arm.forearm_and_hand, posture->elbow, posture->wrist - posture->elbow);
  append(arm.torso, posture->shoulder, arm.description.torso);
}

PlacedScene::PlacedScene() = default;

PlacedScene::PlacedScene(const Scene& scene, const std::vector<State>& run)
    : geometry_(std::make_shared<const Geometry>(scene, run)) {}

void PlacedScene::append_items(const State& state, std::vector<RenderItem>& items) const {
  if (!geometry_) {
    return;
  }
  const Geometry& g = *geometry_;
  Eigen::Isometry3d T_camera_world = Eigen::Isometry3d::Identity();
  if (g.moving == Moving::camera) {
    T_camera_world = state.configuration.T_camera_base * g.T_world_base.inverse();
  }
  for (const Fixture& fixture : g.fixtures) {
    items.push_back({&fixture.mesh, T_camera_world * fixture.T_world_mesh, kBackgroundId});
  }
  const double time = g.duration > 0.0 ? (state.stamp - g.begin) / g.duration : 0.0;
  for (const Arm& arm : g.arms) {
    g.append_arm(arm, time, T_camera_world, items);
  }
}

}  // namespace lockbox
