// SPDX-License-Identifier: BSD-3-Clause
// The box is elsewhere when a covered camera is uncovered; and the estimate is thrown 30 cm behind
// the cloud. How many frames until it is found again, and how many seconds live?
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>

#include "command_line/option_checks.hpp"
#include "command_line/progress.hpp"
#include "command_line/shipped_files.hpp"
#include "experiments/experiments.hpp"
#include "kidnap_runs.hpp"
#include "lockbox/evaluation/statistics.hpp"
#include "lockbox/evaluation/table.hpp"

namespace lockbox::app {
namespace {

constexpr int kFramesToFind = 15;

Table rows_of(const std::vector<KidnapRun>& runs) {
  Table table({"kind", "run", "frame", "status", "searches", "translation", "rotation",
               "joint_error", "worst_joint"});
  for (const KidnapRun& run : runs) {
    for (std::size_t i = 0; i < run.frames.size(); ++i) {
      const FrameOutcome& frame = run.frames[i];
      table.add({run.kind, run.number, i, to_string(frame.status), frame.searches,
                 frame.translation, frame.rotation, frame.joints, frame.worst_joint});
    }
  }
  return table;
}

std::string description(const std::string& kind) {
  return kind == "covered" ? "moved while the camera was covered"
                           : "estimate thrown 30 cm behind the cloud";
}

void print_summary(const std::string& kind, const std::vector<KidnapRun>& runs) {
  std::vector<double> frames;
  int own = 0;
  int in_time = 0;
  int covered = 0;
  StatusCount statuses;
  for (const KidnapRun& run : runs) {
    if (run.kind != kind) continue;
    ++own;
    covered += run.trusted_while_covered;
    statuses += count_statuses(run.frames);
    const int found = run.frames_to_find();
    if (found == 0) continue;
    frames.push_back(found);
    in_time += found <= kFramesToFind ? 1 : 0;
  }
  std::cout << '\n'
            << description(kind) << ": found within " << kFramesToFind << " frames in " << in_time
            << " of " << own << " runs\n  never found: " << own - static_cast<int>(frames.size());
  if (!frames.empty()) {
    const Statistics statistics = summarize(frames);
    std::cout << "; frames to find: median " << statistics.median << ", most "
              << statistics.maximum;
  }
  std::cout << "\n  frames called tracking while covered: " << covered << '\n';
  print_status_count(statuses);
}

Table rows_of(const std::vector<LiveKidnapRun>& runs) {
  Table table({"run", "seconds", "frames", "longest_latency_ms", "status", "translation",
               "rotation", "joint_error", "worst_joint"});
  for (const LiveKidnapRun& run : runs) {
    const auto longest = std::max_element(run.search_latency.begin(), run.search_latency.end());
    const FrameOutcome& last = run.frames.back();
    table.add({run.number, run.seconds.value_or(std::nan("")), run.frames.size(),
               longest == run.search_latency.end() ? std::nan("") : *longest,
               to_string(last.status), last.translation, last.rotation, last.joints,
               last.worst_joint});
  }
  return table;
}

void print_latency(const char* when, const std::vector<double>& milliseconds) {
  if (milliseconds.empty()) return;
  const Statistics statistics = summarize(milliseconds);
  std::cout << "  latency of a frame " << when << ": median " << statistics.median << " ms, 95 % "
            << statistics.percentile_95 << " ms\n";
}

void print_summary(const std::vector<LiveKidnapRun>& runs) {
  std::vector<double> seconds;
  std::vector<double> usual;
  std::vector<double> searching;
  StatusCount statuses;
  for (const LiveKidnapRun& run : runs) {
    if (run.seconds) seconds.push_back(*run.seconds);
    usual.insert(usual.end(), run.usual_latency.begin(), run.usual_latency.end());
    searching.insert(searching.end(), run.search_latency.begin(), run.search_latency.end());
    statuses += count_statuses(run.frames);
  }
  std::cout << "\nmoved while the camera was covered, live: found in " << seconds.size() << " of "
            << runs.size() << " runs\n"
            << std::fixed << std::setprecision(2);
  if (!seconds.empty()) {
    const Statistics statistics = summarize(seconds);
    std::cout << "  seconds to find: median " << statistics.median << ", 95 % "
              << statistics.percentile_95 << ", most " << statistics.maximum << '\n';
  }
  print_latency("before", usual);
  print_latency("until it is found", searching);
  print_status_count(statuses);
}

Panel error_panel(const std::string& kind, const std::vector<KidnapRun>& runs) {
  Panel panel{"frames after the event", "translation error (mm)", {}, true};
  panel.title = description(kind);
  for (const KidnapRun& run : runs) {
    if (run.kind != kind) continue;
    Curve curve{"run " + std::to_string(run.number), {}, {}};
    for (std::size_t i = 0; i < run.frames.size(); ++i) {
      curve.x.push_back(static_cast<double>(i));
      curve.y.push_back(1000.0 * run.frames[i].translation);
    }
    panel.curves.push_back(curve);
  }
  return panel;
}

class Kidnap : public Experiment {
 public:
  void add_options(CLI::App& options) override {
    options
        .add_option("--runs", runs_,
                    "Runs of each of two kinds, camera covered and estimate thrown: twice as many")
        ->check(positive());
    options
        .add_option("--live-runs", live_runs_,
                    "Further runs by the clock, as from a camera, of up to half a minute each")
        ->check(not_negative());
  }

 private:
  bool run_model(const ArticulatedModel& model, const ExperimentSettings& settings) override {
    const Recording still =
        simulate(model, still_states(usual_view(model), kFramesBeforeKidnap + kFramesAfterKidnap),
                 read_scene(find_scene("room")), settings);
    std::vector<KidnapRun> runs;
    std::vector<LiveKidnapRun> live;
    Progress progress("kidnap " + model.tree.name, static_cast<std::size_t>(2 * runs_ + live_runs_),
                      settings.quiet, "runs");
    for (int number = 0; number < runs_; ++number) {
      runs.push_back(run_covered(model, number, settings));
      runs.push_back(run_thrown(model, still, number, settings.seed));
      progress.update(runs.size(), to_string(runs.back().frames.back().status));
    }
    for (int number = 0; number < live_runs_; ++number) {
      live.push_back(run_live(model, number, settings));
      progress.update(runs.size() + live.size(), live.back().seconds ? "found" : "not found");
    }
    progress.finish();
    for (const char* kind : {"covered", "thrown"}) print_summary(kind, runs);
    if (!live.empty()) print_summary(live);
    const auto stem = settings.output / ("kidnap_" + model.tree.name);
    write_table(stem.string() + ".csv", rows_of(runs));
    write_table(stem.string() + "_live.csv", rows_of(live));
    draw(stem, {model.tree.name + ": error after it was lost",
                {error_panel("covered", runs), error_panel("thrown", runs)}});
    return true;
  }

  int runs_ = 20;
  int live_runs_ = 20;
};

}  // namespace

std::unique_ptr<Experiment> make_kidnap_experiment() {
  return std::make_unique<Kidnap>();
}

}  // namespace lockbox::app
