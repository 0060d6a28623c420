// SPDX-License-Identifier: BSD-3-Clause
#include "free_form_scene.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

#include "lockbox/core/error.hpp"
#include "lockbox/core/units.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/model/model_bounds.hpp"
#include "lockbox/model/variable_range.hpp"
#include "lockbox/simulation/model_visibility.hpp"
#include "lockbox/simulation/placed_scene.hpp"
#include "lockbox/terms/collision_term.hpp"

namespace lockbox::evaluation {
namespace {

constexpr int kMostDraws = 400;
constexpr double kMostCut = 0.02;  // of the object, outside the image
/// Shares of a view that count as not hidden, and as hidden by a third.
constexpr double kClear = 0.08;
constexpr double kLeastHidden = 0.26;
constexpr double kMostHidden = 0.40;
constexpr double kUsualSize = 0.5;  // metres; larger objects are seen from farther away

Eigen::Isometry3d looking(const Eigen::Vector3d& from, const Eigen::Vector3d& at, double roll) {
  const Eigen::Vector3d forward = (at - from).normalized();
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = from;
  pose.linear().col(2) = forward;
  pose.linear().col(0) = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  pose.linear().col(1) = forward.cross(pose.linear().col(0));
  pose.rotate(Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitZ()));
  return pose;
}

SceneBox box_at(const Eigen::Vector3d& size, const Eigen::Vector3d& centre, double turn,
                const Eigen::Vector3d& axis) {
  SceneBox box;
  box.frame = SceneFrame::base;
  box.size = size;
  box.pose.translation() = centre;
  box.pose.linear() = Eigen::AngleAxisd(turn, axis).toRotationMatrix();
  return box;
}

void draw_joints(const ArticulatedModel& model, RandomDraws& random, Configuration& truth) {
  CollisionTerm collision(model, CollisionOptions{});
  std::vector<Eigen::Isometry3d> poses;
  for (int draw = 0; draw < kMostDraws; ++draw) {
    for (int v = 0; v < model.tree.variables(); ++v) {
      const VariableRange range = variable_range(model.tree, v);
      truth.q[v] = random.uniform(range.lower, range.upper);
    }
    forward_kinematics(model.tree, truth, poses);
    if (collision.cost(model, poses) <= 0.0) return;
  }
}

/// The height of what the object stands on: that of its foot, or of what hangs below it.
double table_of(const Eigen::AlignedBox3d& object) {
  return std::min(0.0, object.min().z());
}

/// Boxes around the object, none in it; on the table or in the air behind and beside it.
void add_clutter(const Eigen::AlignedBox3d& object, const Eigen::Vector3d& to_camera, bool on_table,
                 RandomDraws& random, Scene& scene) {
  const double reach = 0.5 * object.diagonal().norm();
  const int boxes = static_cast<int>(random.uniform(2.0, 6.0));
  while (static_cast<int>(scene.boxes.size()) < boxes) {
    const Eigen::Vector3d size = random.uniform({0.04, 0.04, 0.04}, {0.2, 0.2, 0.25});
    const double turn = random.uniform(-std::numbers::pi, std::numbers::pi);
    Eigen::Vector3d way = random.direction();
    if (on_table) way = Eigen::Vector3d(way.x(), way.y(), 0.0).normalized();
    if (!on_table && way.dot(to_camera) > 0.0) way = -way;
    Eigen::Vector3d centre =
        object.center() + (reach + 0.5 * size.norm() + random.uniform(0.01, 0.3)) * way;
    if (on_table) centre.z() = table_of(object) + 0.5 * size.z();
    scene.boxes.push_back(
        box_at(size, centre, turn, on_table ? Eigen::Vector3d(Eigen::Vector3d::UnitZ()) : way));
  }
}

/// A wall, and a table under the object.
void add_room(const Eigen::AlignedBox3d& object, const Eigen::Vector3d& to_camera, bool on_table,
              RandomDraws& random, Scene& scene) {
  const double behind = object.diagonal().norm() + random.uniform(0.3, 1.0);
  Eigen::Vector3d normal = to_camera + 0.2 * random.direction();
  if (on_table) normal.z() = 0.0;
  scene.planes.push_back(
      {SceneFrame::base, object.center() - behind * to_camera, normal.normalized(), {8.0, 8.0}});
  if (!on_table) return;
  const double turn = random.uniform(-std::numbers::pi, std::numbers::pi);
  const double x = random.uniform(-0.3, 0.3);
  const double y = random.uniform(-0.2, 0.2);
  scene.boxes.push_back(
      box_at({1.4, 0.9, 0.04}, {x, y, table_of(object) - 0.02}, turn, Eigen::Vector3d::UnitZ()));
}

SceneBox draw_cover(const Eigen::AlignedBox3d& object, const Eigen::Vector3d& to_camera,
                    RandomDraws& random) {
  const double size = object.diagonal().norm();
  const Eigen::Vector3d edges = random.uniform({0.2, 0.2, 0.2}, {1.0, 1.0, 1.0}) * size;
  const Eigen::Vector3d aside = random.direction();
  const Eigen::Vector3d centre = object.center() +
                                 (0.5 * size + 0.5 * edges.norm() + 0.02) * to_camera +
                                 random.uniform(0.0, 0.8) * size * aside;
  const Eigen::Vector3d axis = random.direction();
  return box_at(edges, centre, random.uniform(-std::numbers::pi, std::numbers::pi), axis);
}

/// drawn: with its joints, and whether it is on a table and covered.
FreeFormScene place(const ArticulatedModel& model, const PinholeCamera& camera, FreeFormScene drawn,
                    RandomDraws& random) {
  Configuration& truth = drawn.truth.configuration;
  truth.T_camera_base.setIdentity();
  const Eigen::AlignedBox3d object = model_bounds(model.tree, truth);
  const double away = std::max(1.0, object.diagonal().norm() / kUsualSize);
  for (int draw = 0; draw < kMostDraws; ++draw) {
    Eigen::Vector3d to_camera = random.direction();
    if (drawn.on_table) {
      const double height = random.uniform(15.0, 55.0) * kRadians;
      to_camera.z() = 0.0;
      to_camera = std::cos(height) * to_camera.normalized();
      to_camera.z() = std::sin(height);
    }
    const double roll = drawn.on_table ? random.uniform(-0.2, 0.2)
                                       : random.uniform(-std::numbers::pi, std::numbers::pi);
    const double distance = away * random.uniform(0.5, 1.1);
    const Eigen::Vector3d target = object.center() + 0.15 * distance * random.direction();
    truth.T_camera_base = looking(object.center() + distance * to_camera, target, roll).inverse();
    drawn.scene = Scene{};
    drawn.scene.moving = Moving::camera;
    add_room(object, to_camera, drawn.on_table, random, drawn.scene);
    add_clutter(object, to_camera, drawn.on_table, random, drawn.scene);
    if (drawn.is_covered) drawn.scene.boxes.push_back(draw_cover(object, to_camera, random));
    const PlacedScene placed(drawn.scene, {drawn.truth});
    const ModelVisibility seen =
        VisibilityMeter(model.tree, camera, placed, Executor()).measure(drawn.truth);
    drawn.hidden = seen.hidden;
    const bool fits = drawn.is_covered ? seen.hidden > kLeastHidden && seen.hidden < kMostHidden
                                       : seen.hidden < kClear;
    if (seen.cut < kMostCut && fits) return drawn;
  }
  throw InputError(model.file.string(), "no view of this object fits the image");
}

}  // namespace

FreeFormScene draw_free_form_scene(const ArticulatedModel& model, const PinholeCamera& camera,
                                   RandomDraws random) {
  FreeFormScene drawn;
  drawn.on_table = random.chance(0.5);
  drawn.is_covered = random.chance(0.5);
  drawn.truth.configuration = rest_configuration(model.tree);
  draw_joints(model, random, drawn.truth.configuration);
  return place(model, camera, std::move(drawn), random);
}

FreeFormScene draw_free_form_scene(const ArticulatedModel& model, const PinholeCamera& camera,
                                   const Configuration& joints, RandomDraws random) {
  FreeFormScene drawn;
  drawn.on_table = random.chance(0.5);
  drawn.is_covered = random.chance(0.5);
  drawn.truth.configuration = joints;
  return place(model, camera, std::move(drawn), random);
}

}  // namespace lockbox::evaluation
