// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/random_scene.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "lockbox/core/error.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/model/variable_range.hpp"
#include "lockbox/rendering/body_item.hpp"
#include "lockbox/simulation/placed_scene.hpp"
#include "lockbox/simulation/random_draws.hpp"
#include "lockbox/terms/collision_term.hpp"

namespace lockbox {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kMaxDraws = 2000;
constexpr int kReduction = 4;         ///< of the image in which shares are counted, per axis
constexpr double kWholeShare = 0.98;  ///< of the view within the image: not cut off
constexpr double kMaxCutOff = 0.9;

Eigen::AlignedBox3d bounds_at(const KinematicTree& tree, Configuration configuration) {
  configuration.T_camera_base.setIdentity();
  std::vector<Eigen::Isometry3d> poses;
  forward_kinematics(tree, configuration, poses);
  Eigen::AlignedBox3d box;
  for (std::size_t b = 0; b < tree.bodies.size(); ++b) {
    for (const auto& vertex : tree.bodies[b].mesh.vertices) box.extend(poses[b] * vertex);
  }
  return box;
}

/// Any joint positions at which no part penetrates another.
Eigen::VectorXd draw_joints(const ArticulatedModel& model, RandomDraws& random) {
  const KinematicTree& tree = model.tree;
  CollisionTerm collision(model, CollisionOptions{});
  Configuration configuration = rest_configuration(tree);
  std::vector<Eigen::Isometry3d> poses;
  for (int draw = 0; draw < kMaxDraws; ++draw) {
    for (int v = 0; v < tree.variables(); ++v) {
      const VariableRange range = variable_range(tree, v);
      configuration.q[v] = random.uniform(range.lower, range.upper);
    }
    forward_kinematics(tree, configuration, poses);
    if (collision.cost(model, poses) <= 0.0) break;
  }
  return configuration.q;
}

/// The front at a random distance, tilt and roll, its centre anywhere in (or, for views that are to
/// be cut off, near) the image.
Eigen::Isometry3d draw_pose(const PinholeCamera& camera, const Eigen::Vector3d& front_centre,
                            bool cut_off, const RandomSceneOptions& options, RandomDraws& random) {
  const double reach = cut_off ? 1.0 : 0.5;
  const double u = camera.width * (0.5 + reach * random.uniform(-1.0, 1.0));
  const double v = camera.height * (0.5 + reach * random.uniform(-1.0, 1.0));
  const Eigen::Vector3d to_object = camera.back_project(u, v, 1.0).normalized();
  const double distance = random.uniform(options.min_distance, options.max_distance);
  const double tilt = std::acos(random.uniform(std::cos(options.max_tilt), 1.0));
  const double azimuth = random.uniform(-kPi, kPi);
  const double roll = random.uniform(-kPi, kPi);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = (Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), -to_object) *
                   Eigen::AngleAxisd(azimuth, Eigen::Vector3d::UnitZ()) *
                   Eigen::AngleAxisd(tilt, Eigen::Vector3d::UnitX()) *
                   Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitZ()))
                      .toRotationMatrix();
  pose.translation() = distance * to_object - pose.linear() * front_centre;
  return pose;
}

/// A box beside, below or behind the object, clear of it.
SceneBox draw_box(const Eigen::AlignedBox3d& object, RandomDraws& random) {
  const double size = object.diagonal().norm();
  SceneBox box;
  box.frame = SceneFrame::base;
  for (int i = 0; i < 3; ++i) box.size[i] = random.uniform(0.08, 0.5);
  const Eigen::Vector3d axis = random.direction();
  box.pose.linear() = Eigen::AngleAxisd(random.uniform(-kPi, kPi), axis).toRotationMatrix();
  do {
    const double away = random.uniform(0.3, 1.0);
    box.pose.translation() = object.center() + random.direction() * away * (size + 0.5);
  } while (object.exteriorDistance(box.pose.translation()) < 0.5 * box.size.norm() + 0.01);
  return box;
}

/// An arm that reaches from the side into the view, somewhat in front of the object.
SceneArm draw_arm(const Eigen::AlignedBox3d& object, RandomDraws& random) {
  const double z = object.max().z() + random.uniform(0.1, 0.3);
  const double angle = random.uniform(-kPi, kPi);
  const Eigen::Vector3d inward(std::cos(angle), std::sin(angle), 0.0);
  const Eigen::Vector3d centre(object.center().x(), object.center().y(), z);
  const double up = random.uniform(-1.0, 1.0);
  const Eigen::Vector3d wrist = centre + 0.4 * object.sizes().head<2>().norm() *
                                             Eigen::Vector3d(random.uniform(-1.0, 1.0), up, 0.0);
  SceneArm arm;
  arm.frame = SceneFrame::base;
  arm.elbow = Eigen::Vector3d(-inward.y(), inward.x(), 0.4);
  arm.waypoints.push_back({0.0, wrist - 0.5 * inward + Eigen::Vector3d(0.0, 0.0, 0.05), wrist});
  return arm;
}

Scene draw_surroundings(Placement placement, const Eigen::AlignedBox3d& rest,
                        const Eigen::AlignedBox3d& object, const RandomSceneOptions& options,
                        RandomDraws& random) {
  Scene scene;
  scene.moving = Moving::camera;
  const auto add_plane = [&](const Eigen::Vector3d& point, const Eigen::Vector3d& normal) {
    scene.planes.push_back({SceneFrame::base, point, normal, {8.0, 8.0}});
  };
  const Eigen::Vector3d tilted = Eigen::Vector3d::UnitZ() + 0.3 * random.direction();
  if (placement == Placement::on_wall) {
    add_plane({0.0, 0.0, rest.min().z()}, Eigen::Vector3d::UnitZ());
  } else {
    add_plane({0.0, 0.0, object.min().z() - random.uniform(0.3, 1.5)}, tilted);
  }
  if (placement == Placement::on_table) {
    SceneBox table;
    table.frame = SceneFrame::base;
    table.size = {random.uniform(1.2, 2.0), 0.04, random.uniform(0.7, 1.0)};
    table.pose.translation() << random.uniform(-0.3, 0.3), object.min().y() - 0.5 * table.size.y(),
        rest.center().z() + random.uniform(-0.2, 0.2);
    scene.boxes.push_back(table);
  }
  const int boxes = static_cast<int>(random.uniform(1.0, 6.0));
  for (int i = 0; i < boxes; ++i) scene.boxes.push_back(draw_box(object, random));
  if (random.chance(options.arm_share)) scene.arms.push_back(draw_arm(object, random));
  return scene;
}

/// Counts the model's pixels in a picture that reaches one image beyond the image on each side.
class ViewShares {
 public:
  ViewShares(const KinematicTree& tree, const PinholeCamera& camera)
      : tree_(tree), inner_(reduced(camera, kReduction)), renderer_(wide(inner_), Executor(1)) {}

  /// Returns, of the object alone, the share of its view that lies in the image.
  double in_image(const State& truth) {
    whole_ = draw(truth, nullptr);
    return whole_ == 0 ? 0.0 : static_cast<double>(draw_inner()) / static_cast<double>(whole_);
  }
  /// Returns, after in_image, the share of its whole view that is in the image and unoccluded.
  double visible(const State& truth, const PlacedScene& scene) {
    draw(truth, &scene);
    return static_cast<double>(draw_inner()) / static_cast<double>(whole_);
  }

 private:
  static PinholeCamera wide(PinholeCamera camera) {
    camera.cx += camera.width;
    camera.cy += camera.height;
    camera.width *= 3;
    camera.height *= 3;
    return camera;
  }
  std::size_t draw(const State& truth, const PlacedScene* scene) {
    items_.clear();
    forward_kinematics(tree_, truth.configuration, poses_);
    for (std::size_t b = 0; b < tree_.bodies.size(); ++b) {
      items_.push_back(body_item(tree_, b, poses_[b]));
    }
    if (scene != nullptr) scene->append_items(truth, items_);
    renderer_.render(items_, image_);
    return count(0, image_.width, 0, image_.height);
  }
  std::size_t draw_inner() const {
    return count(inner_.width, 2 * inner_.width, inner_.height, 2 * inner_.height);
  }
  std::size_t count(int left, int right, int top, int bottom) const {
    std::size_t pixels = 0;
    for (int v = top; v < bottom; ++v) {
      for (int u = left; u < right; ++u) {
        const auto id = image_.id[image_.index(u, v)];
        pixels += id != kNothing && id < kBackgroundId ? 1U : 0U;
      }
    }
    return pixels;
  }

  const KinematicTree& tree_;
  PinholeCamera inner_;
  DepthRenderer renderer_;
  RenderedDepth image_;
  std::vector<RenderItem> items_;
  std::vector<Eigen::Isometry3d> poses_;
  std::size_t whole_ = 0;
};

Placement draw_placement(const RandomSceneOptions& options, RandomDraws& random) {
  const double draw = random.uniform(0.0, 1.0);
  if (draw < options.on_wall_share) return Placement::on_wall;
  return draw < options.on_wall_share + options.on_table_share ? Placement::on_table
                                                               : Placement::free;
}

}  // namespace

RandomScene draw_random_scene(const ArticulatedModel& model, const PinholeCamera& camera,
                              std::uint64_t seed, std::uint64_t number,
                              const RandomSceneOptions& options) {
  return draw_random_scene(model, model.tree, camera, seed, number, options);
}

RandomScene draw_random_scene(const ArticulatedModel& model, const KinematicTree& built,
                              const PinholeCamera& camera, std::uint64_t seed, std::uint64_t number,
                              const RandomSceneOptions& options) {
  RandomDraws random(seed, number);
  RandomScene drawn;
  drawn.placement = draw_placement(options, random);
  drawn.cut_off = random.chance(options.cut_off_share);
  drawn.truth.configuration = rest_configuration(built);
  if (built.variables() > 0) drawn.truth.configuration.q = draw_joints(model, random);
  const Eigen::AlignedBox3d rest = bounds_at(built, rest_configuration(built));
  const Eigen::AlignedBox3d object = bounds_at(built, drawn.truth.configuration);
  const Eigen::Vector3d front_centre(rest.center().x(), rest.center().y(), rest.max().z());
  ViewShares shares(built, camera);
  for (int draw = 0; draw < kMaxDraws; ++draw) {
    drawn.truth.configuration.T_camera_base =
        draw_pose(camera, front_centre, drawn.cut_off, options, random);
    const double in_image = shares.in_image(drawn.truth);
    if (drawn.cut_off ? in_image > kMaxCutOff || in_image < options.least_visible
                      : in_image < kWholeShare) {
      continue;
    }
    drawn.scene = draw_surroundings(drawn.placement, rest, object, options, random);
    drawn.visible = shares.visible(drawn.truth, PlacedScene(drawn.scene, {drawn.truth}));
    if (drawn.visible >= options.least_visible) return drawn;
  }
  throw InputError(model.file.string(), "no view of this model fits the ranges of the scenes");
}

}  // namespace lockbox
