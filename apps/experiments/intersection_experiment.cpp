// SPDX-License-Identifier: BSD-3-Clause
// What the collision term does to the joints: off, in its literal form, and on eroded surfaces; on
// a model whose parts touch exactly, and on a copy whose contact faces overlap.
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
#include "lockbox/evaluation/table.hpp"
#include "lockbox/terms/collision_mode_name.hpp"

namespace lockbox::app {
namespace {

/// One model tracked in one mode, against the truth.
struct ModeRun {
  std::string model;
  CollisionMode mode;
  Evaluation evaluation;
  /// By joint: the largest error in units of the reported sigma, over frames that determine it.
  std::vector<double> largest_normalized_error;
};

/// Raises each joint's largest error in units of its sigma by what this frame shows.
void update_normalized_errors(const KinematicTree& tree, const TrackingResult& result,
                              const State& truth, std::vector<double>& largest) {
  for (std::size_t j = 0; j < tree.joints.size(); ++j) {
    const auto unknown = static_cast<std::size_t>(unknown_of(tree.joints[j].variable));
    if (unknown >= result.observable.size() || !result.observable[unknown]) continue;
    const int joint = static_cast<int>(j);
    double error = joint_position(tree, result.configuration, joint) -
                   joint_position(tree, truth.configuration, joint);
    if (tree.joints[j].type == JointType::continuous) error = std::remainder(error, kFullTurn);
    const double sigma =
        std::abs(tree.joints[j].multiplier) * result.sigma(unknown_of(tree.joints[j].variable));
    if (sigma > 0.0) largest[j] = std::max(largest[j], std::abs(error) / sigma);
  }
}

ModeRun track_in_mode(const ArticulatedModel& model, const Recording& recording,
                      CollisionMode mode) {
  TrackerOptions options;
  options.registration.collision = mode;
  Tracker tracker(model, options);
  tracker.start(recording.truth.front().configuration);
  const auto results = track(tracker, recording);
  ModeRun run{model.tree.name, mode, {}, std::vector<double>(model.tree.joints.size(), 0.0)};
  for (std::size_t i = 0; i < results.size(); ++i) {
    update_normalized_errors(model.tree, results[i], recording.truth[i],
                             run.largest_normalized_error);
  }
  run.evaluation = evaluate(model.tree, to_states(model.tree, results), {{}, recording.truth});
  return run;
}

/// One row an unknown and mode; RMSE and the rest in metres or radians.
Table rows_of(const KinematicTree& tree, const std::vector<ModeRun>& runs) {
  Table table({"model", "collision", "unknown", "unit", "frames", "rmse", "median", "percentile_95",
               "maximum", "normalized"});
  for (const ModeRun& run : runs) {
    const auto add = [&](const std::string& unknown, const char* unit, const Statistics& errors,
                         double normalized) {
      table.add({run.model, mode_name(run.mode), unknown, unit, errors.count, errors.rmse,
                 errors.median, errors.percentile_95, errors.maximum, normalized});
    };
    add("base_translation", "m", run.evaluation.translation, std::nan(""));
    add("base_rotation", "rad", run.evaluation.rotation, std::nan(""));
    for (const auto& summary : run.evaluation.joints) {
      const auto joint = static_cast<std::size_t>(summary.joint);
      add(tree.joints[joint].name, tree.joints[joint].type == JointType::prismatic ? "m" : "rad",
          summary.errors, run.largest_normalized_error[joint]);
    }
  }
  return table;
}

/// One line an unknown, one column a mode.
void print_errors(const KinematicTree& tree, const std::vector<ModeRun>& runs) {
  std::cout << '\n' << std::left << std::setw(36) << (tree.name + ", RMSE") << std::right;
  for (const auto& run : runs) std::cout << std::setw(12) << mode_name(run.mode);
  std::cout << std::setw(34) << "largest |error| / sigma, literal\n"
            << std::fixed << std::setprecision(3);
  const auto row = [&](const std::string& name, const std::string& unit, auto&& value) {
    std::cout << std::left << std::setw(26) << name << std::setw(10) << unit << std::right;
    for (const auto& run : runs) std::cout << std::setw(12) << value(run.evaluation);
  };
  row("base translation", "mm",
      [](const Evaluation& e) { return kMillimetres * e.translation.rmse; });
  std::cout << '\n';
  row("base rotation", "degrees", [](const Evaluation& e) { return kDegrees * e.rotation.rmse; });
  std::cout << '\n';
  for (std::size_t i = 0; i < runs.front().evaluation.joints.size(); ++i) {
    const auto index = static_cast<std::size_t>(runs.front().evaluation.joints[i].joint);
    const bool slides = tree.joints[index].type == JointType::prismatic;
    const double scale = slides ? kMillimetres : kDegrees;
    row(tree.joints[index].name, slides ? "mm" : "degrees",
        [&](const Evaluation& e) { return scale * e.joints[i].errors.rmse; });
    for (const auto& run : runs) {
      if (run.mode == CollisionMode::literal) {
        std::cout << std::setw(33) << run.largest_normalized_error[index];
      }
    }
    std::cout << '\n';
  }
}

/// One panel a joint, one curve a mode: the joint's error over time.
Figure error_figure(const KinematicTree& tree, const std::vector<ModeRun>& runs) {
  Figure figure;
  figure.title = tree.name + ": joint errors by collision term";
  for (const int joint : tree.file_order) {
    const auto index = static_cast<std::size_t>(joint);
    const bool slides = tree.joints[index].type == JointType::prismatic;
    Panel panel;
    panel.x_label = "time (s)";
    panel.y_label = tree.joints[index].name + (slides ? " (mm)" : " (degrees)");
    for (const auto& run : runs) {
      Curve curve;
      curve.name = mode_name(run.mode);
      for (const auto& frame : run.evaluation.frames) {
        curve.x.push_back(frame.stamp);
        curve.y.push_back((slides ? kMillimetres : kDegrees) * frame.joints(joint));
      }
      panel.curves.push_back(curve);
    }
    figure.panels.push_back(panel);
  }
  return figure;
}

class Intersection : public Experiment {
 public:
  void add_options(CLI::App& options) override {
    options.alias("collision");
    options.add_option("--frames", frames_, "Of each run")->check(positive());
    options.add_option("--scene", scene_, "Scene file, or the name of a shipped scene")
        ->type_name("FILE");
  }

 private:
  std::vector<std::string> default_models() const override {
    return {"lockbox", "lockbox_overlapping"};
  }

  bool run_model(const ArticulatedModel& model, const ExperimentSettings& settings) override {
    TrajectoryOptions trajectory;
    trajectory.frames = frames_;
    trajectory.T_camera_base = usual_view(model).T_camera_base;
    const Recording recording = simulate(model, possible_motion(model, trajectory),
                                         read_scene(find_scene(scene_)), settings);
    const std::vector<CollisionMode> modes = {CollisionMode::off, CollisionMode::literal,
                                              CollisionMode::eroded};
    std::vector<ModeRun> runs;
    Progress progress("track " + model.tree.name, modes.size(), settings.quiet, "modes");
    for (const auto mode : modes) {
      runs.push_back(track_in_mode(model, recording, mode));
      progress.update(runs.size(), mode_name(mode));
    }
    progress.finish();
    print_errors(model.tree, runs);
    const auto stem = settings.output / ("intersection_" + model.tree.name);
    write_table(stem.string() + ".csv", rows_of(model.tree, runs));
    draw(stem, error_figure(model.tree, runs));
    return true;
  }

  int frames_ = 120;
  std::string scene_ = "room";
};

}  // namespace

std::unique_ptr<Experiment> make_intersection_experiment() {
  return std::make_unique<Intersection>();
}

}  // namespace lockbox::app
