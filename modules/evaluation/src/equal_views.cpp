// SPDX-License-Identifier: BSD-3-Clause
#include "equal_views.hpp"

#include <algorithm>
#include <cmath>

#include "lockbox/core/square.hpp"
#include "lockbox/initialization/initializer.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/model/symmetry.hpp"
#include "lockbox/rendering/body_item.hpp"
#include "lockbox/simulation/simulator.hpp"

namespace lockbox {
namespace {

constexpr double kMostSigmas = 3.0;   // that a pixel tells
constexpr double kUsualErrors = 1.5;  // as multiples of the bound, docs/experiments.md

RenderedDepth drawn(const KinematicTree& tree, const Configuration& configuration,
                    std::vector<RenderItem> items, DepthRenderer& renderer) {
  std::vector<Eigen::Isometry3d> poses;
  forward_kinematics(tree, configuration, poses);
  for (std::size_t b = 0; b < tree.bodies.size(); ++b) {
    items.push_back(body_item(tree, b, poses[b]));
  }
  RenderedDepth image;
  renderer.render(items, image);
  return image;
}

}  // namespace

EqualViews::EqualViews(const ArticulatedModel& model, const AnswerComparison& comparison,
                       const PinholeCamera& camera, const SensorModel& sensor,
                       const PlacedScene& scene, const State& truth, const Eigen::VectorXd& bound,
                       std::uint64_t seed, const Executor& executor)
    : model_(model),
      comparison_(comparison),
      camera_(camera),
      sensor_(sensor),
      scene_(scene),
      truth_(truth),
      bound_(bound),
      executor_(executor),
      registration_(model, options_.registration, executor) {
  DepthFrame image;
  Simulator(model.tree, camera, scene, sensor, seed, executor).simulate(truth, 0, image);
  cloud_.assign(image, options_.cloud, executor_);
}

bool EqualViews::holds(const TrackingResult& answer) {
  const Configuration followed =
      registration_.align(cloud_, answer.configuration, {0.0, options_.start_iterations})
          .configuration;
  return is_other(followed) && looks_like_truth(followed);
}

bool EqualViews::any() {
  InitializerOptions options;
  options.registration = options_.registration;
  Initializer initializer(model_, options, executor_);
  const std::vector<int> all = options.registration.free_variables(model_.tree.variables());
  const std::vector<Eigen::Isometry3d> turns = find_body_symmetries(model_, 0);
  return std::any_of(turns.begin() + 1, turns.end(), [&](const Eigen::Isometry3d& turn) {
    TrackingResult other;
    other.configuration = truth_.configuration;
    other.configuration.T_camera_base = truth_.configuration.T_camera_base * turn;
    other.configuration = initializer.find_joints(cloud_, other.configuration, all).configuration;
    return holds(other);
  });
}

bool EqualViews::is_other(const Configuration& configuration) const {
  TrackingResult other;
  other.status = TrackingStatus::tracking;
  other.configuration = configuration;
  return !comparison_.compare(other, truth_, bound_).wrong.empty();
}

bool EqualViews::looks_like_truth(const Configuration& configuration) const {
  std::vector<RenderItem> scenery;
  scene_.append_items(truth_, scenery);
  DepthRenderer renderer(camera_, executor_);
  const RenderedDepth a = drawn(model_.tree, truth_.configuration, scenery, renderer);
  const RenderedDepth b = drawn(model_.tree, configuration, scenery, renderer);
  double squares = 0.0;
  for (std::size_t i = 0; i < a.depth.size(); ++i) {
    const double z_a = static_cast<double>(a.depth[i]);
    const double z_b = static_cast<double>(b.depth[i]);
    if (z_a == z_b) continue;  // nothing in both, too
    const double sigma = depth_sigma(sensor_, camera_, std::min(z_a, z_b));
    squares += square(std::min(kMostSigmas, std::abs(z_a - z_b) / sigma));
  }
  const auto unknowns = static_cast<double>(model_.tree.unknowns());
  return squares / correlation_area(sensor_) <= square(kUsualErrors) * unknowns;
}

}  // namespace lockbox
