// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/drawn_view.hpp"

#include <array>
#include <cmath>

#include "free_form_scene.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/core/units.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/model/model_bounds.hpp"
#include "lockbox/model/variable_range.hpp"
#include "lockbox/simulation/model_visibility.hpp"
#include "lockbox/simulation/placed_scene.hpp"
#include "lockbox/terms/collision_term.hpp"

namespace lockbox {
namespace {

constexpr int kMostJointDraws = 100;
constexpr int kMostViewDraws = 500;
constexpr double kMostCut = 0.15;    // of the object, outside the image
constexpr double kMostHidden = 0.5;  // of the object, by what it stands on
constexpr double kAllClosed = 0.4;   // chance
constexpr double kOpen = 0.5;        // chance of a joint where not all are closed
constexpr double kLeastOpen = 0.1;   // of a joint's range
constexpr double kExtent = 8.0;      // of walls, floors, metres

/// Two axes of the object's base: out of its front, and up.
struct Sides {
  Eigen::Vector3d out;
  Eigen::Vector3d up;

  Eigen::Vector3d right() const { return up.cross(out); }
};

Sides sides_of(DrawnKind kind) {
  if (kind == DrawnKind::furniture) return {-Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()};
  return {Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitY()};
}

/// Returns how many joints do not stand at rest.
int draw_joints(const ArticulatedModel& model, RandomDraws random, Configuration& configuration) {
  configuration = rest_configuration(model.tree);
  if (random.chance(kAllClosed)) return 0;
  const Eigen::VectorXd rest = configuration.q;
  CollisionTerm collision(model, CollisionOptions{});
  std::vector<Eigen::Isometry3d> poses;
  for (int draw = 0; draw < kMostJointDraws; ++draw) {
    int open = 0;
    for (int v = 0; v < model.tree.variables(); ++v) {
      const VariableRange range = variable_range(model.tree, v);
      const bool is_open = random.chance(kOpen);
      const double share = random.uniform(kLeastOpen, 1.0);
      configuration.q[v] = is_open ? range.lower + share * range.extent() : rest[v];
      open += is_open ? 1 : 0;
    }
    forward_kinematics(model.tree, configuration, poses);
    if (open > 0 && collision.cost(model, poses) <= 0.0) return open;
  }
  configuration.q = rest;
  return 0;
}

ScenePlane plane_at(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) {
  return {SceneFrame::base, point, normal, {kExtent, kExtent}};
}

/// Furniture stands on the floor, at a wall or before it. A board hangs on a wall, stands before
/// one, or lies on a table.
void draw_surroundings(DrawnKind kind, const Eigen::AlignedBox3d& bounds, RandomDraws& random,
                       DrawnView& view) {
  const Sides sides = sides_of(kind);
  const bool is_board = kind == DrawnKind::board;
  constexpr std::array kPlacements = {"wall", "floor", "table"};
  const auto placement = static_cast<std::size_t>(random.uniform(0.0, is_board ? 3.0 : 2.0));
  view.placement = kPlacements[placement];
  const bool touches = view.placement != "floor";
  const double behind = touches ? 0.0 : random.uniform(0.05, 0.6);
  const double below = is_board && touches ? random.uniform(0.3, 1.2) : 0.0;
  const auto lowest = [&](const Eigen::Vector3d& axis) -> Eigen::Vector3d {
    const Eigen::Vector3d corner = (axis.array() > 0.0).select(bounds.min(), bounds.max());
    return axis.dot(corner) * axis;
  };
  view.scene.moving = Moving::camera;
  view.scene.planes.push_back(plane_at(lowest(sides.out) - behind * sides.out, sides.out));
  if (view.placement == "table") return;
  view.scene.planes.push_back(plane_at(lowest(sides.up) - below * sides.up, sides.up));
}

/// Draws a pose seen from straight ahead, or from the side and above.
Eigen::Isometry3d draw_pose(DrawnKind kind, const Eigen::Vector3d& front, bool is_oblique,
                            bool lies, RandomDraws& random) {
  const Sides sides = sides_of(kind);
  const double side = random.chance(0.5) ? 1.0 : -1.0;
  const double yaw =
      kRadians * side * (is_oblique ? random.uniform(20.0, 50.0) : random.uniform(0.0, 12.0));
  const double pitch =
      kRadians * (is_oblique ? random.uniform(5.0, 35.0) : random.uniform(0.0, 15.0));
  const double roll = lies ? random.uniform(-180.0, 180.0) : random.uniform(-3.0, 3.0);
  const double distance = random.uniform(1.2, 2.0);
  const Eigen::Vector3d to_camera =
      std::cos(pitch) * (std::cos(yaw) * sides.out + std::sin(yaw) * sides.right()) +
      std::sin(pitch) * sides.up;
  const Eigen::Vector3d position = front + distance * to_camera;
  const Eigen::Vector3d target =
      front + random.uniform(-0.1, 0.1) * sides.right() + random.uniform(-0.1, 0.1) * sides.up;
  const Eigen::Vector3d forward = (target - position).normalized();
  Eigen::Isometry3d T_base_camera = Eigen::Isometry3d::Identity();
  T_base_camera.translation() = position;
  T_base_camera.linear().col(2) = forward;
  T_base_camera.linear().col(0) = forward.cross(sides.up).normalized();
  T_base_camera.linear().col(1) = forward.cross(T_base_camera.linear().col(0));
  T_base_camera.rotate(Eigen::AngleAxisd(roll * kRadians, Eigen::Vector3d::UnitZ()));
  return T_base_camera.inverse();
}

void draw_household_view(const ArticulatedModel& model, const PinholeCamera& camera,
                         RandomDraws random, DrawnView& view) {
  const evaluation::FreeFormScene drawn =
      evaluation::draw_free_form_scene(model, camera, view.truth.configuration, random);
  view.truth = drawn.truth;
  view.scene = drawn.scene;
  view.placement = drawn.on_table ? "table" : "air";
  view.is_oblique = true;
}

}  // namespace

DrawnView draw_view(DrawnKind kind, const ArticulatedModel& model, const PinholeCamera& camera,
                    const ObjectBlock& block, std::uint64_t number) {
  DrawnView view;
  Configuration& truth = view.truth.configuration;
  view.open = draw_joints(model, block.draws(ObjectBlock::Purpose::joints, number), truth);
  RandomDraws random = block.draws(ObjectBlock::Purpose::view, number);
  if (kind == DrawnKind::household) {
    draw_household_view(model, camera, random, view);
    return view;
  }
  const Eigen::AlignedBox3d bounds = model_bounds(model.tree, rest_configuration(model.tree));
  draw_surroundings(kind, bounds, random, view);
  view.is_oblique = random.chance(0.5);
  const Eigen::Vector3d out = sides_of(kind).out;
  const Eigen::Vector3d front = bounds.center() + 0.5 * std::abs(out.dot(bounds.sizes())) * out;
  for (int draw = 0; draw < kMostViewDraws; ++draw) {
    truth.T_camera_base =
        draw_pose(kind, front, view.is_oblique, view.placement == "table", random);
    const PlacedScene placed(view.scene, {view.truth});
    const ModelVisibility seen =
        VisibilityMeter(model.tree, camera, placed, Executor()).measure(view.truth);
    if (seen.cut <= kMostCut && seen.hidden <= kMostHidden) return view;
  }
  throw InputError(model.file.string(), "no view of this object fits the image");
}

DrawnView scaled(DrawnView view, const KinematicTree& tree, double size) {
  Configuration& truth = view.truth.configuration;
  truth.T_camera_base.translation() *= size;
  for (const Joint& joint : tree.joints) {
    if (joint.type == JointType::prismatic && !joint.is_mimic) truth.q[joint.variable] *= size;
  }
  for (ScenePlane& plane : view.scene.planes) {
    plane.point *= size;
    plane.extent *= size;
  }
  for (SceneBox& box : view.scene.boxes) {
    box.size *= size;
    box.pose.translation() *= size;
  }
  return view;
}

std::string draw_sensor(const ObjectBlock& block, std::uint64_t number) {
  constexpr std::array kTuning = {"primesense", "primesense-quiet"};
  constexpr std::array kTests = {"primesense", "structured-light", "white"};
  RandomDraws random = block.draws(ObjectBlock::Purpose::sensor, number);
  const double draw = random.uniform(0.0, 1.0);
  if (block.is_for_tuning()) return kTuning[draw < 0.7 ? 0 : 1];
  return kTests[static_cast<std::size_t>(3.0 * draw)];
}

}  // namespace lockbox
