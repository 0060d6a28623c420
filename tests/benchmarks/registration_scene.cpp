// SPDX-License-Identifier: BSD-3-Clause
#include "registration_scene.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/simulation/simulator.hpp"
#include "lockbox/simulation/trajectory.hpp"
#include "lockbox/terms/collision_term.hpp"

namespace lockbox {
namespace {

constexpr double kLockboxDistance = 1.04;  // metres: its doors reach beyond the image
constexpr std::size_t kLockboxViews = 8;

Configuration displaced(const KinematicTree& tree, const Configuration& truth) {
  Eigen::VectorXd step = Eigen::VectorXd::Zero(tree.unknowns());
  step.head<3>().setConstant(0.001 / std::sqrt(3.0));
  step.segment<3>(3).setConstant(0.05 / std::sqrt(3.0) * std::numbers::pi / 180.0);
  for (int v = 0; v < tree.variables(); ++v) {
    const VariableLimits limits = variable_limits(tree, v);
    const double range = limits.upper - limits.lower;
    const double way = 0.005 * (std::isfinite(range) ? range : 2.0 * std::numbers::pi);
    step[unknown_of(v)] = truth.q[v] + way <= limits.upper ? way : -way;
  }
  return stepped(truth, step);
}

/// The middle of a run in which no part passes through another.
std::vector<Configuration> mid_motion(const ArticulatedModel& model) {
  CollisionTerm collision(model, RegistrationOptions{});
  BodyPoses poses;
  TrajectoryOptions options;
  options.T_camera_base = facing_pose(kLockboxDistance);
  options.is_possible = [&](const Configuration& configuration) {
    forward_kinematics(model.tree, configuration, poses);
    return collision.cost(model, poses) == 0.0;
  };
  const std::vector<State> run = generate_trajectory(model.tree, options);
  std::vector<Configuration> middle;
  for (std::size_t i = run.size() / 2; middle.size() < kLockboxViews; ++i) {
    middle.push_back(run[i].configuration);
  }
  return middle;
}

}  // namespace

RegistrationScene make_scene(ArticulatedModel model, const std::vector<Configuration>& truths,
                             const PinholeCamera& camera) {
  RegistrationScene scene{std::move(model), {}};
  std::vector<State> run(truths.size());
  for (std::size_t i = 0; i < run.size(); ++i) {
    run[i].configuration = truths[i];
  }
  const double wall = truths.front().T_camera_base.translation().z() + 0.4;
  Scene room;
  room.planes.push_back({SceneFrame::world, {0.0, 0.0, wall}, {0.0, 0.0, -1.0}, {5.0, 5.0}});
  Simulator simulator(scene.model.tree, camera, PlacedScene(room, run), sensor_model("primesense"),
                      1, Executor());
  DepthFrame frame;
  for (std::size_t i = 0; i < run.size(); ++i) {
    simulator.simulate(run[i], i, frame);
    scene.views.push_back({truths[i], displaced(scene.model.tree, truths[i]), {}});
    scene.views.back().cloud.assign(frame, CloudOptions{}, Executor());
  }
  return scene;
}

const RegistrationScene& shipped_lockbox() {
  static const RegistrationScene scene = shipped_lockbox(kPrimeSense);
  return scene;
}

RegistrationScene shipped_lockbox(const PinholeCamera& camera) {
  ArticulatedModel model = load_model(kLockboxFile);
  const std::vector<Configuration> truths = mid_motion(model);
  return make_scene(std::move(model), truths, camera);
}

RegistrationOptions all_points() {
  RegistrationOptions options;
  options.point_budget = 0;
  return options;
}

void time_registration(benchmark::State& state, const RegistrationScene& scene, int threads,
                       const RegistrationOptions& options) {
  ArticulatedRegistration registration(scene.model, options, Executor(threads));
  RegistrationResult result;
  std::size_t i = 0;
  for (auto _ : state) {
    const View& view = scene.views[i++ % scene.views.size()];
    registration.align(view.cloud, view.predicted, kFromPrediction, result);
    benchmark::DoNotOptimize(result);
  }
  state.counters["points"] = result.explained_points;
}

void on_one_and_two_threads(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgName("threads")->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();
}

}  // namespace lockbox
