// SPDX-License-Identifier: BSD-3-Clause
// Objects that are not quite their models, cameras that are not quite their calibrations: what the
// tracker, who is told nothing of it, makes of them, and what it believes.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "command_line/interruption.hpp"
#include "command_line/option_checks.hpp"
#include "command_line/parameters.hpp"
#include "command_line/progress.hpp"
#include "command_line/shipped_files.hpp"
#include "command_line/whole_file.hpp"
#include "experiments/experiments.hpp"
#include "experiments/shard.hpp"
#include "lockbox/evaluation/mismatch.hpp"
#include "lockbox/evaluation/possible_motion.hpp"
#include "lockbox/evaluation/table.hpp"
#include "lockbox/simulation/deviation_presets.hpp"
#include "lockbox/simulation/scene_fit.hpp"
#include "mismatch_report.hpp"

namespace lockbox::app {
namespace {

constexpr double kSwing = 0.1;  // of the camera along each axis, metres

struct MismatchRun {
  std::string kind;
  std::uint64_t seed;

  std::string text() const { return kind + "_seed" + std::to_string(seed); }
};

/// The sensor that a kind is about, and how far away the base is; nothing where it is not.
struct OtherSensor {
  std::string name;
  std::optional<double> distance;  ///< metres
};

OtherSensor other_sensor(const std::string& kind, Severity severity) {
  const bool is_severe = severity == Severity::severe;
  if (kind == "stereo") return {kind, is_severe ? 1.9 : 1.25};
  if (kind == "time-of-flight") return {is_severe ? "time-of-flight-biased" : kind, std::nullopt};
  return {};
}

class Mismatch : public Experiment {
 public:
  bool continues() const override { return true; }

  void add_options(CLI::App& options) override {
    options.add_option("--severity", severity_, "moderate or severe")
        ->check(one_of({"moderate", "severe"}));
    options
        .add_option("--kind", kinds_,
                    "What deviates (repeatable): none, scale, sizes, bend, joints, added, missing, "
                    "focal, centre, distortion, depth-scale, depth-bend, frames or all; or "
                    "the sensor: stereo or time-of-flight")
        ->check(one_of(mismatch_kinds()))
        ->default_str("each of them");
    options.add_option("--seeds", seeds_, "Of each kind")->check(positive());
    options.add_option("--frames", frames_, "Of each run")->check(positive());
    add_set_option(options, parameters_);
    shard_.add_to(options);
  }

 private:
  std::vector<std::string> default_models() const override {
    return {"lockbox", "cabinet", "rigid_block", "board_door_block"};
  }

  /// Returns what the files' names say of the tracker that is not as usual.
  std::string settings_text() const {
    std::string text;
    for (const std::string& parameter : parameters_) text += "_" + parameter;
    return text;
  }

  /// So ordered that an interrupted experiment has met all kinds alike.
  std::vector<MismatchRun> planned_runs(const ExperimentSettings& settings) const {
    std::vector<MismatchRun> runs;
    for (int i = 0; i < seeds_; ++i) {
      for (const std::string& kind : kinds_) {
        runs.push_back({kind, settings.seed + static_cast<std::uint64_t>(i)});
      }
    }
    return runs;
  }

  /// distance: of the base, metres; that of its usual view if it is none.
  std::vector<State> motion(const ArticulatedModel& model, std::optional<double> distance) const {
    TrajectoryOptions options;
    options.frames = frames_;
    options.T_camera_base = usual_view(model).T_camera_base;
    if (distance) {
      auto position = options.T_camera_base.translation();
      position *= *distance / position.norm();
    }
    options.sway = kSwing;
    return possible_motion(model, options);
  }

  bool run_model(const ArticulatedModel& model, const ExperimentSettings& settings) override {
    const auto stem =
        settings.output / ("mismatch_" + model.tree.name + "_" + severity_ + "_" + settings.sensor +
                           "_" + std::to_string(frames_) + "frames" + settings_text());
    const auto file = shard_.rows_file(stem);
    Table table = continued_table(file, mismatch_columns());
    std::set<std::string> done;
    for (const Row& row : table.rows()) {
      done.insert(table.word(row, "kind") + "_seed" + table.word(row, "seed"));
    }
    const auto runs = planned_runs(settings);
    const Interruption interruption;
    Progress progress("mismatch " + model.tree.name, shard_.runs_of(runs.size()), settings.quiet,
                      "runs");
    std::size_t finished = 0;
    for (std::size_t i = 0; i < runs.size() && !interruption.requested(); ++i) {
      if (!shard_.holds(i)) continue;
      progress.update(finished++, runs[i].kind);
      if (done.count(runs[i].text()) > 0) continue;
      const auto deviation = preset_deviation(
          other_sensor(runs[i].kind, severity()).name.empty() ? runs[i].kind : "none", severity(),
          runs[i].seed, model.tree);
      if (!deviation) continue;  // the model has nothing of the kind
      write_whole_file(stem.string() + "_" + runs[i].text() + ".yaml", deviation_text(*deviation));
      std::vector<MismatchFrame> frames;
      if (!is_done([&] { frames = tracked(model, *deviation, runs[i], settings); })) break;
      add_mismatch_rows(table, runs[i].kind, runs[i].seed, frames);
      write_table(file, table);
    }
    progress.finish();
    print_mismatch_report(model.tree.name + ", " + severity_, rows_files(stem));
    return !interruption.requested();
  }

  std::vector<MismatchFrame> tracked(const ArticulatedModel& model, const Deviation& deviation,
                                     const MismatchRun& run,
                                     const ExperimentSettings& settings) const {
    const OtherSensor other = other_sensor(run.kind, severity());
    const SensorModel sensor = sensor_model(other.name.empty() ? settings.sensor : other.name);
    const std::vector<State> truth = motion(model, other.distance);
    const Scene scene = fitted(read_scene(find_scene("room")), model.tree, truth.front());
    TrackerOptions tracker;
    tracker.stop_request = interruption::requested;
    for (const std::string& parameter : parameters_) set_parameter(parameter, tracker);
    return track_mismatch(model, truth, deviation,
                          {sensor.camera, sensor, scene, run.seed, tracker},
                          interruption::executor());
  }

  Severity severity() const {
    return severity_ == "severe" ? Severity::severe : Severity::moderate;
  }

  std::string severity_ = "moderate";
  std::vector<std::string> kinds_ = mismatch_kinds();
  int seeds_ = 5;
  int frames_ = 60;
  std::vector<std::string> parameters_;
  Shard shard_;
};

}  // namespace

std::unique_ptr<Experiment> make_mismatch_experiment() {
  return std::make_unique<Mismatch>();
}

}  // namespace lockbox::app
