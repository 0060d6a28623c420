// SPDX-License-Identifier: BSD-3-Clause
// Box and camera still; the start is off by a given distance and angle in random directions.
#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <memory>
#include <set>

#include "command_line/interruption.hpp"
#include "command_line/option_checks.hpp"
#include "command_line/progress.hpp"
#include "command_line/shipped_files.hpp"
#include "convergence_runs.hpp"
#include "experiments/experiments.hpp"
#include "experiments/shard.hpp"
#include "lockbox/core/units.hpp"
#include "lockbox/evaluation/frame_outcome.hpp"
#include "lockbox/simulation/random_draws.hpp"

namespace lockbox::app {
namespace {

constexpr double kMetres = 0.01;  // a centimetre
constexpr int kLargestTranslation = 45;
constexpr int kLargestRotation = 55;
constexpr std::size_t kRestFrames = 10;
constexpr double kRestTranslation = 1.5e-3;  // metres; what noise moves from frame to frame
constexpr double kRestRotation = 0.25 * kRadians;

/// Displaces it alike for all variants, and for all numbers of samples.
Configuration displaced(const Configuration& truth, const ConvergenceRun& run, std::uint64_t seed) {
  const auto number = static_cast<std::uint64_t>(
      (std::lround(run.start_translation) * 1000 + std::lround(run.start_rotation)) * 100000 +
      run.sample);
  RandomDraws random(seed, number);
  Configuration start = truth;
  start.T_camera_base.translation() += kMetres * run.start_translation * random.direction();
  start.T_camera_base.linear() =
      Eigen::AngleAxisd(kRadians * run.start_rotation, random.direction()) *
      start.T_camera_base.linear();
  return start;
}

/// Whether an estimate has come to rest: box and camera are still, so that it will stay.
class Rest {
 public:
  bool reached_with(const Configuration& configuration) {
    last_.push_back(configuration.T_camera_base);
    if (last_.size() > kRestFrames) last_.pop_front();
    return last_.size() == kRestFrames && std::all_of(last_.begin(), last_.end(), [&](auto& pose) {
             return (pose.translation() - last_.back().translation()).norm() < kRestTranslation &&
                    Eigen::AngleAxisd(pose.linear().transpose() * last_.back().linear()).angle() <
                        kRestRotation;
           });
  }

 private:
  std::deque<Eigen::Isometry3d> last_;
};

/// Trackers are made once, for that takes longer than some runs.
struct Follower {
  std::unique_ptr<Tracker> tracker;
  int searches = 0;  ///< in all runs before
};
using Followers = std::map<std::string, Follower>;  ///< by variant

class Convergence : public Experiment {
 public:
  bool continues() const override { return true; }

  void add_options(CLI::App& options) override {
    options.add_option("--samples", samples_, "Runs a cell")->check(between(1, 99999));
    options.add_option("--step", step_, "From one cell to the next, cm and degrees")
        ->check(between(1, 45));
    options.add_option("--frames", frames_, "Of each run, at most; it ends when it rests")
        ->check(positive());
    options.add_option("--tracker", trackers_, "whole, registration (alone), or both")
        ->check(one_of({"whole", "registration"}));
    options.add_option("--joints", joints_, "held, free, or both")->check(one_of({"held", "free"}));
    options.add_option("--success-translation", success_cm_, "Largest error of a success, cm");
    options.add_option("--success-rotation", success_degrees_, "Largest error, degrees");
    shard_.add_to(options);
  }

 private:
  /// All runs, so ordered that an interrupted experiment has filled all cells alike.
  std::vector<ConvergenceRun> planned_runs() const {
    std::vector<ConvergenceRun> runs;
    for (int sample = 0; sample < samples_; ++sample) {
      for (const auto& tracker : trackers_) {
        for (const auto& joints : joints_) {
          for (int rotation = 0; rotation <= kLargestRotation; rotation += step_) {
            for (int translation = 0; translation <= kLargestTranslation; translation += step_) {
              ConvergenceRun& run = runs.emplace_back();
              run.variant = {tracker, joints};
              run.start_translation = translation;
              run.start_rotation = rotation;
              run.sample = sample;
            }
          }
        }
      }
    }
    return runs;
  }

  static TrackerOptions tracker_options(const Variant& variant, const KinematicTree& tree) {
    TrackerOptions options;
    options.search_anywhere = variant.tracker == "whole";
    if (variant.joints == "held") {
      options.registration.locked.assign(static_cast<std::size_t>(tree.variables()), true);
    }
    return options;
  }

  static void follow(const ArticulatedModel& model, const Recording& recording, std::uint64_t seed,
                     Followers& followers, ConvergenceRun& run) {
    const State& truth = recording.truth.front();
    auto& [tracker, searches] = followers[run.variant.text()];
    if (!tracker) {
      tracker = std::make_unique<Tracker>(model, tracker_options(run.variant, model.tree));
    }
    tracker->start(displaced(truth.configuration, run, seed));
    Rest rest;
    FrameOutcome outcome;
    for (const DepthFrame& frame : recording.frames) {
      const TrackingResult& result = tracker->process(frame);
      outcome = compare(model.tree, result, truth);
      ++run.frames;
      run.statuses.add(outcome.status == TrackingStatus::tracking, outcome.is_right());
      const bool may_be_found_yet =
          tracker->options().search_anywhere &&
          (result.status == TrackingStatus::lost || result.status == TrackingStatus::initializing);
      if (rest.reached_with(result.configuration) && !may_be_found_yet) break;
    }
    run.status = to_string(outcome.status);
    run.searches = outcome.searches - searches;
    searches = outcome.searches;
    run.translation = outcome.translation;
    run.rotation = outcome.rotation;
    run.joints = outcome.joints;
    run.worst_joint = outcome.worst_joint;
  }

  bool run_model(const ArticulatedModel& model, const ExperimentSettings& settings) override {
    const auto stem =
        settings.output / ("convergence_" + model.tree.name + "_" + settings.sensor + "_" +
                           std::to_string(frames_) + "frames_seed" + std::to_string(settings.seed));
    const auto file = shard_.rows_file(stem);
    Table table = continued_table(file, convergence_columns());
    write_table(file, table);
    std::set<std::string> done;
    for (const Row& row : table.rows()) done.insert(key(from_row(table, row)));

    const Recording recording = simulate(model, still_states(usual_view(model), frames_),
                                         read_scene(find_scene("room")), settings);
    auto runs = planned_runs();
    const Interruption interruption;
    Progress progress("convergence " + model.tree.name, shard_.runs_of(runs.size()), settings.quiet,
                      "runs");
    std::size_t finished = 0;
    Followers followers;
    for (std::size_t i = 0; i < runs.size() && !interruption.requested(); ++i) {
      if (!shard_.holds(i)) continue;
      if (done.count(key(runs[i])) == 0) {
        follow(model, recording, settings.seed, followers, runs[i]);
        append_row(file, to_row(runs[i]));
      }
      progress.update(++finished, runs[i].status);
    }
    progress.finish();
    report(model.tree.name, stem);
    return !interruption.requested();
  }

  /// Reports the rows of all shards.
  void report(const std::string& name, const std::filesystem::path& stem) const {
    std::map<std::string, ConvergenceRun> runs_by_key;
    for (const auto& file : rows_files(stem)) {
      const Table table = read_table(file, convergence_columns());
      for (const Row& row : table.rows()) {
        const ConvergenceRun run = from_row(table, row);
        runs_by_key[key(run)] = run;
      }
    }
    std::vector<ConvergenceRun> runs;
    runs.reserve(runs_by_key.size());
    for (const auto& [_, run] : runs_by_key) runs.push_back(run);
    const Tolerances success{kMetres * success_cm_, kRadians * success_degrees_};
    print_convergence(runs, success);
    draw(stem, convergence_figure(name, runs, success));
  }

  int samples_ = 20;
  int step_ = 5;
  int frames_ = 93;
  std::vector<std::string> trackers_ = {"whole", "registration"};
  std::vector<std::string> joints_ = {"held", "free"};
  double success_cm_ = 2.0;
  double success_degrees_ = 2.0;
  Shard shard_;
};

}  // namespace

std::unique_ptr<Experiment> make_convergence_experiment() {
  return std::make_unique<Convergence>();
}

}  // namespace lockbox::app
