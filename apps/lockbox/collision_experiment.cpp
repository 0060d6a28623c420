// SPDX-License-Identifier: BSD-3-Clause
#include "collision_experiment.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <locale>
#include <numbers>

#include "lockbox/core/error.hpp"
#include "lockbox/simulation/simulator.hpp"
#include "lockbox/simulation/trajectory.hpp"
#include "lockbox/tracking/tracker.hpp"
#include "parameters.hpp"
#include "primesense_camera.hpp"
#include "progress.hpp"

namespace lockbox::app {
namespace {

constexpr double kFullTurn = 2.0 * std::numbers::pi;

struct Recording {
  std::vector<State> truth;
  std::vector<DepthFrame> frames;
};

Recording simulate(const ArticulatedModel& model, const CollisionExperiment& experiment) {
  TrajectoryOptions options;
  options.frames = experiment.frames;
  if (model.parameters.initial_configuration) {
    options.T_camera_base = model.parameters.initial_configuration->T_camera_base;
  }
  Recording recording{generate_trajectory(model.tree, options), {}};
  Simulator simulator(model.tree, kPrimeSenseCamera, PlacedScene(experiment.scene, recording.truth),
                      sensor_model(experiment.sensor), experiment.seed, Executor());
  Progress progress("simulate " + model.tree.name, recording.truth.size(), experiment.quiet);
  for (std::size_t i = 0; i < recording.truth.size(); ++i) {
    simulator.simulate(recording.truth[i], i, recording.frames.emplace_back());
    progress.update(i + 1);
  }
  progress.finish();
  return recording;
}

/// Raises each joint's largest error in units of its sigma by what this frame shows.
void update_normalized_errors(const KinematicTree& tree, const TrackingResult& result,
                              const State& truth, std::vector<double>& largest) {
  for (std::size_t j = 0; j < tree.joints.size(); ++j) {
    const auto unknown = static_cast<std::size_t>(6 + tree.joints[j].variable);
    if (unknown >= result.observable.size() || !result.observable[unknown]) continue;
    const int joint = static_cast<int>(j);
    double error = joint_position(tree, result.configuration, joint) -
                   joint_position(tree, truth.configuration, joint);
    if (tree.joints[j].type == JointType::continuous) error = std::remainder(error, kFullTurn);
    const double sigma =
        std::abs(tree.joints[j].multiplier) * result.sigma(6 + tree.joints[j].variable);
    if (sigma > 0.0) largest[j] = std::max(largest[j], std::abs(error) / sigma);
  }
}

CollisionRun track(const ArticulatedModel& model, const Recording& recording, CollisionMode mode,
                   bool quiet) {
  TrackerOptions options;
  options.registration.collision = mode;
  Tracker tracker(model, options);
  tracker.start(recording.truth.front().configuration);
  CollisionRun run{model.tree.name, mode, {}, std::vector<double>(model.tree.joints.size(), 0.0)};
  StatesFile estimate;
  Progress progress("track " + model.tree.name + ", collision " + collision_mode_text(mode),
                    recording.frames.size(), quiet);
  for (std::size_t i = 0; i < recording.frames.size(); ++i) {
    DepthFrame frame = recording.frames[i];
    frame.stamp = recording.truth[i].stamp;
    const TrackingResult& result = tracker.process(frame);
    update_normalized_errors(model.tree, result, recording.truth[i], run.largest_normalized_error);
    const bool known = result.configuration.T_camera_base.matrix().allFinite();
    estimate.states.push_back(
        {result.stamp, result.configuration, to_string(result.status), known, {}});
    progress.update(i + 1, to_string(result.status));
  }
  progress.finish();
  run.evaluation = evaluate(model.tree, estimate, {{}, recording.truth});
  return run;
}

}  // namespace

std::vector<CollisionRun> run_collision_experiment(const ArticulatedModel& model,
                                                   const CollisionExperiment& experiment) {
  const Recording recording = simulate(model, experiment);
  std::vector<CollisionRun> runs;
  for (const auto mode : {CollisionMode::off, CollisionMode::literal, CollisionMode::eroded}) {
    runs.push_back(track(model, recording, mode, experiment.quiet));
  }
  return runs;
}

void write_collision_runs(const std::filesystem::path& file, const KinematicTree& tree,
                          const std::vector<CollisionRun>& runs) {
  std::ofstream stream(file);
  stream.imbue(std::locale::classic());
  stream << "model,collision,unknown,unit,frames,rmse,median,percentile_95,maximum,normalized\n";
  for (const CollisionRun& run : runs) {
    const auto row = [&](const std::string& unknown, const char* unit, const Statistics& errors,
                         double normalized) {
      stream << run.model << ',' << collision_mode_text(run.mode) << ',' << unknown << ',' << unit
             << ',' << errors.count << ',' << errors.rmse << ',' << errors.median << ','
             << errors.percentile_95 << ',' << errors.maximum << ',' << normalized << '\n';
    };
    row("base_translation", "m", run.evaluation.translation, std::nan(""));
    row("base_rotation", "rad", run.evaluation.rotation, std::nan(""));
    for (const auto& summary : run.evaluation.joints) {
      const auto joint = static_cast<std::size_t>(summary.joint);
      row(tree.joints[joint].name, tree.joints[joint].type == JointType::prismatic ? "m" : "rad",
          summary.errors, run.largest_normalized_error[joint]);
    }
  }
  stream.close();
  if (!stream) throw InputError(file.string(), "cannot be written");
}

}  // namespace lockbox::app
