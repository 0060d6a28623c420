// SPDX-License-Identifier: BSD-3-Clause
#include "experiment.hpp"

#include <algorithm>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <utility>

#include "command_line/interruption.hpp"
#include "command_line/progress.hpp"
#include "command_line/shipped_files.hpp"
#include "lockbox/simulation/trajectory.hpp"

namespace lockbox::app {
namespace {

ArticulatedModel loaded(const std::string& name, bool quiet) {
  const Activity activity("loading " + name, quiet);
  return load_model(find_model(name));
}

}  // namespace

bool Experiment::run(const ExperimentSettings& settings) {
  const auto models = settings.models.empty() ? default_models() : settings.models;
  return std::all_of(models.begin(), models.end(), [&](const std::string& name) {
    return run_model(loaded(name, settings.quiet), settings);
  });
}

Configuration usual_view(const ArticulatedModel& model) {
  if (model.parameters.initial_configuration) return *model.parameters.initial_configuration;
  Configuration configuration = rest_configuration(model.tree);
  configuration.T_camera_base = facing_pose(1.3);
  return configuration;
}

Recording simulate(const ArticulatedModel& model, const std::vector<State>& truth,
                   const Scene& scene, const ExperimentSettings& settings) {
  const SensorModel sensor = sensor_model(settings.sensor);
  Progress progress("simulate " + model.tree.name, truth.size(), settings.quiet);
  Recording recording = simulate_recording(
      model.tree, truth, {scene, sensor.camera, sensor, settings.seed}, interruption::executor(),
      [&](std::size_t done) { progress.update(done); });
  progress.finish();
  return recording;
}

std::vector<TrackingResult> track(Tracker& tracker, const Recording& recording) {
  std::vector<TrackingResult> results;
  for (const DepthFrame& frame : recording.frames) results.push_back(tracker.process(frame));
  return results;
}

void print_status_count(const StatusCount& frames) {
  const auto print = [](const char* what, std::size_t all, const char* of_these, std::size_t part) {
    std::ostringstream line;  // leaves the format of what follows alone
    line << what << ": " << all << ", " << of_these << ": " << part;
    if (all > 0) {
      const double percent = 100.0 * static_cast<double>(part) / static_cast<double>(all);
      line << std::fixed << std::setprecision(2) << " (" << percent << " %)";
    }
    std::cout << line.str() << '\n';
  };
  print("frames called tracking", frames.tracking, "of these wrong", frames.tracking_but_wrong);
  print("frames that are right", frames.right, "of these called tracking",
        frames.right - frames.right_but_not_tracking);
}

Curve cumulative_curve(const std::string& name, std::vector<double> values) {
  std::sort(values.begin(), values.end());
  Curve curve{name, std::move(values), {}};
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    curve.y.push_back(100.0 * static_cast<double>(i + 1) / static_cast<double>(curve.x.size()));
  }
  return curve;
}

bool is_done(const std::function<void()>& run) try {
  run();
  return true;
} catch (const Stopped&) {
  if (!interruption::requested()) throw;
  return false;
}

void draw(const std::filesystem::path& stem, const Figure& figure) {
  const std::string hindrance = write_figure(stem, figure);
  if (!hindrance.empty()) std::cerr << "lockbox: no figure: " << hindrance << '\n';
}

}  // namespace lockbox::app
