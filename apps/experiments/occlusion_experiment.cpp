// SPDX-License-Identifier: BSD-3-Clause
// An arm sweeps over the box while all joints move: against the same run without the arm.
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>

#include "command_line/option_checks.hpp"
#include "command_line/progress.hpp"
#include "command_line/shipped_files.hpp"
#include "experiments.hpp"
#include "lockbox/core/units.hpp"
#include "lockbox/evaluation/frame_outcome.hpp"
#include "lockbox/evaluation/metrics.hpp"
#include "lockbox/evaluation/possible_motion.hpp"
#include "lockbox/evaluation/run_bounds.hpp"
#include "lockbox/evaluation/table.hpp"

namespace lockbox::app {
namespace {

/// The run with the arm and the one without, both counted where the view with the arm determines
/// an unknown.
struct OcclusionRuns {
  std::vector<TrackingResult> results;  ///< with the arm
  Evaluation with_arm;
  Evaluation without_arm;
};

double scale(const Joint& joint) {
  return joint.type == JointType::prismatic ? kMillimetres : kDegrees;
}

Table rows_of(const KinematicTree& tree, const OcclusionRuns& runs) {
  Table table({"frame", "status", "occluded", "translation", "rotation", "translation_without_arm",
               "rotation_without_arm", "joint", "determined", "error", "sigma",
               "error_without_arm"});
  for (std::size_t i = 0; i < runs.results.size(); ++i) {
    const FrameErrors& with = runs.with_arm.frames[i];
    const FrameErrors& without = runs.without_arm.frames[i];
    for (const int joint : tree.file_order) {
      const auto index = static_cast<std::size_t>(joint);
      table.add({i, with.status, runs.results[i].occluded, with.translation, with.rotation,
                 without.translation, without.rotation, tree.joints[index].name,
                 with.determined.joints[index] ? 1 : 0, with.joints(joint),
                 with.joint_sigmas(joint), without.joints(joint)});
    }
  }
  return table;
}

void print_row(const std::string& name, double unit, const Statistics& with,
               const Statistics& without) {
  std::cout << std::left << std::setw(28) << name << std::right << std::setw(8) << with.count
            << std::setw(12) << unit * with.rmse << std::setw(12) << unit * without.rmse;
}

void print_summary(const KinematicTree& tree, const OcclusionRuns& runs) {
  const Evaluation& with = runs.with_arm;
  const Evaluation& without = runs.without_arm;
  std::cout << "\nRMSE (mm, degrees)      frames seen    with arm     without  frames unseen, "
               "honest\n"
            << std::fixed << std::setprecision(3);
  print_row("base translation", kMillimetres, with.translation, without.translation);
  std::cout << '\n';
  print_row("base rotation", kDegrees, with.rotation, without.rotation);
  std::cout << '\n';
  for (std::size_t i = 0; i < with.joints.size(); ++i) {
    const Joint& joint = tree.joints[static_cast<std::size_t>(with.joints[i].joint)];
    const Honesty& honesty = with.joints[i].honesty;
    print_row(joint.name, scale(joint), with.joints[i].errors, without.joints[i].errors);
    std::cout << std::setw(15) << honesty.frames << std::setw(8) << honesty.honest << '\n';
  }
  const auto most_hidden =
      std::max_element(runs.results.begin(), runs.results.end(),
                       [](auto& a, auto& b) { return a.occluded < b.occluded; });
  std::cout << std::setprecision(1) << "hidden at most: " << 100.0 * most_hidden->occluded
            << " % of the box; searches: " << runs.results.back().searches << '\n';
  print_status_count(with.statuses);
}

Curve curve_of(const std::string& name, const Evaluation& evaluation,
               const std::function<double(const FrameErrors&)>& value) {
  Curve curve{name, {}, {}};
  for (const FrameErrors& frame : evaluation.frames) {
    curve.x.push_back(frame.stamp);
    curve.y.push_back(value(frame));
  }
  return curve;
}

Panel comparison(const std::string& label, const OcclusionRuns& runs,
                 const std::function<double(const FrameErrors&)>& value) {
  return {
      "time (s)",
      label,
      {curve_of("with arm", runs.with_arm, value), curve_of("without", runs.without_arm, value)}};
}

Figure error_figure(const KinematicTree& tree, const OcclusionRuns& runs) {
  Figure figure{tree.name + ": an arm sweeps over it", {}};
  Curve hidden{"hidden", {}, {}};
  for (const TrackingResult& result : runs.results) {
    hidden.x.push_back(result.stamp);
    hidden.y.push_back(100.0 * result.occluded);
  }
  figure.panels.push_back({"time (s)", "hidden (% of the box)", {hidden}});
  figure.panels.push_back(comparison("translation error (mm)", runs, [](const FrameErrors& frame) {
    return kMillimetres * frame.translation;
  }));
  for (const int index : tree.file_order) {
    const Joint& joint = tree.joints[static_cast<std::size_t>(index)];
    const std::string unit = joint.type == JointType::prismatic ? " (mm)" : " (degrees)";
    Panel panel = comparison(joint.name + unit, runs, [&](const FrameErrors& frame) {
      return scale(joint) * frame.joints(index);
    });
    panel.curves.push_back(curve_of(
        "3 sigma, with arm", runs.with_arm,
        [&](const FrameErrors& frame) { return 3.0 * scale(joint) * frame.joint_sigmas(index); }));
    figure.panels.push_back(panel);
  }
  return figure;
}

class Occlusion : public Experiment {
 public:
  void add_options(CLI::App& options) override {
    options.add_option("--frames", frames_, "Of each run")->check(between(2, 100000));
    options.add_option("--scene", scene_, "Scene with an arm: file, or name of a shipped one")
        ->type_name("FILE");
  }

 private:
  bool run_model(const ArticulatedModel& model, const ExperimentSettings& settings) override {
    TrajectoryOptions trajectory;
    trajectory.frames = frames_;
    trajectory.T_camera_base = usual_view(model).T_camera_base;
    const auto truth = possible_motion(model, trajectory);
    const Scene with_arm = read_scene(find_scene(scene_));
    Scene without_arm = with_arm;
    without_arm.arms.clear();

    const SensorModel sensor = sensor_model(settings.sensor);
    Progress progress("bounds " + model.tree.name, truth.size(), settings.quiet);
    const auto bounds =
        compute_run_bounds(model.tree, truth, sensor.camera, sensor, PlacedScene(with_arm, truth),
                           Executor(), [&](std::size_t i) { progress.update(i); });
    progress.finish();

    OcclusionRuns runs;
    const auto evaluate_in = [&](const Scene& scene) {
      Tracker tracker(model, TrackerOptions{});
      tracker.start(truth.front().configuration);
      runs.results = track(tracker, simulate(model, truth, scene, settings));
      return evaluate(model.tree, to_states(model.tree, runs.results), {{}, truth}, bounds);
    };
    runs.without_arm = evaluate_in(without_arm);
    runs.with_arm = evaluate_in(with_arm);
    print_summary(model.tree, runs);
    const auto stem = settings.output / ("occlusion_" + model.tree.name);
    write_table(stem.string() + ".csv", rows_of(model.tree, runs));
    draw(stem, error_figure(model.tree, runs));
    return true;
  }

  int frames_ = 120;
  std::string scene_ = "room_with_person";
};

}  // namespace

std::unique_ptr<Experiment> make_occlusion_experiment() {
  return std::make_unique<Occlusion>();
}

}  // namespace lockbox::app
