// SPDX-License-Identifier: BSD-3-Clause
// The box is elsewhere when a covered camera is uncovered; and the estimate is thrown 30 cm behind
// the cloud. How many frames until it is found again?
#include <algorithm>
#include <iomanip>
#include <iostream>
#include <numbers>

#include "experiments.hpp"
#include "lockbox/evaluation/frame_outcome.hpp"
#include "lockbox/evaluation/random_draws.hpp"
#include "lockbox/evaluation/statistics.hpp"
#include "lockbox/evaluation/table.hpp"
#include "option_checks.hpp"
#include "progress.hpp"
#include "shipped_files.hpp"

namespace lockbox::app {
namespace {

constexpr double kRadians = std::numbers::pi / 180.0;
constexpr int kFramesBefore = 10;
constexpr int kFramesCovered = 30;  // a second
constexpr int kFramesAfter = 30;
constexpr int kAllowedFrames = 15;
constexpr double kThrown = 0.3;  // metres

/// What happened from the first frame on that follows the event; before it are frames while the
/// camera was covered.
struct KidnapRun {
  std::string kind;
  int number = 0;
  int trusted_while_covered = 0;
  std::vector<FrameOutcome> frames;

  /// How many frames it took until the estimate was trusted, and right to the end; 0: it was not.
  int frames_to_find() const {
    std::size_t first = frames.size();
    while (first > 0 && frames[first - 1].is_right()) --first;
    while (first < frames.size() && frames[first].status != TrackingStatus::tracking) ++first;
    return first < frames.size() ? static_cast<int>(first) + 1 : 0;
  }
};

Configuration moved(const Configuration& from, RandomDraws& random) {
  Configuration to = from;
  to.T_camera_base.translation() += random.uniform(0.1, 0.3) * random.direction();
  to.T_camera_base.linear() =
      Eigen::AngleAxisd(kRadians * random.uniform(5.0, 30.0), random.direction()) *
      to.T_camera_base.linear();
  return to;
}

/// The box moves while the camera sees nothing.
Recording covered_recording(const ArticulatedModel& model, std::uint64_t number,
                            const ExperimentSettings& settings) {
  RandomDraws random(settings.seed, number);
  const Configuration before = usual_view(model);
  const Configuration after = moved(before, random);
  auto truth = still_states(before, kFramesBefore + kFramesCovered + kFramesAfter);
  for (std::size_t i = kFramesBefore + kFramesCovered / 2; i < truth.size(); ++i) {
    truth[i].configuration = after;
  }
  ExperimentSettings silent = settings;
  silent.quiet = true;
  Recording recording = simulate(model, truth, read_scene(find_scene("room")), silent);
  for (std::size_t i = kFramesBefore; i < kFramesBefore + kFramesCovered; ++i) {
    std::fill(recording.frames[i].depth.begin(), recording.frames[i].depth.end(), 0);
  }
  return recording;
}

KidnapRun run_covered(const ArticulatedModel& model, int number,
                      const ExperimentSettings& settings) {
  const Recording recording =
      covered_recording(model, static_cast<std::uint64_t>(number), settings);
  Tracker tracker(model, TrackerOptions{});
  tracker.start(recording.truth.front().configuration);
  const auto results = track(tracker, recording);
  KidnapRun run{"covered", number, 0, {}};
  for (std::size_t i = kFramesBefore; i < results.size(); ++i) {
    const FrameOutcome outcome = compare(model.tree, results[i], recording.truth[i]);
    if (i < kFramesBefore + kFramesCovered) {
      run.trusted_while_covered += outcome.status == TrackingStatus::tracking ? 1 : 0;
    } else {
      run.frames.push_back(outcome);
    }
  }
  return run;
}

/// Along the line of sight, with a random turn of up to ten degrees.
Configuration thrown_behind(Configuration configuration, RandomDraws& random) {
  Eigen::Isometry3d& pose = configuration.T_camera_base;
  pose.translation() += kThrown * pose.translation().normalized();
  pose.rotate(Eigen::AngleAxisd(kRadians * random.uniform(0.0, 10.0), random.direction()));
  return configuration;
}

KidnapRun run_thrown(const ArticulatedModel& model, const Recording& recording, int number,
                     std::uint64_t seed) {
  RandomDraws random(seed, static_cast<std::uint64_t>(number));
  Tracker tracker(model, TrackerOptions{});
  tracker.start(recording.truth.front().configuration);
  KidnapRun run{"thrown", number, 0, {}};
  for (std::size_t i = 0; i < recording.frames.size(); ++i) {
    if (i == kFramesBefore) {
      tracker.start(thrown_behind(recording.truth[i].configuration, random));
    }
    const TrackingResult& result = tracker.process(recording.frames[i]);
    if (i >= kFramesBefore) run.frames.push_back(compare(model.tree, result, recording.truth[i]));
  }
  return run;
}

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
  std::ptrdiff_t trusted_wrongly = 0;
  for (const KidnapRun& run : runs) {
    if (run.kind != kind) continue;
    ++own;
    covered += run.trusted_while_covered;
    trusted_wrongly += std::count_if(run.frames.begin(), run.frames.end(),
                                     [](auto& frame) { return frame.is_wrongly_trusted(); });
    const int found = run.frames_to_find();
    if (found == 0) continue;
    frames.push_back(found);
    in_time += found <= kAllowedFrames ? 1 : 0;
  }
  std::cout << '\n'
            << description(kind) << ": found within " << kAllowedFrames << " frames in " << in_time
            << " of " << own << " runs\n  never found: " << own - static_cast<int>(frames.size());
  if (!frames.empty()) {
    const Statistics statistics = summarize(frames);
    std::cout << "; frames to find: median " << statistics.median << ", most "
              << statistics.maximum;
  }
  std::cout << "\n  frames trusted wrongly: " << trusted_wrongly
            << "; frames called tracking while covered: " << covered << '\n';
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
    options.add_option("--runs", runs_, "Of each kind")->check(positive());
  }

 private:
  bool run_model(const ArticulatedModel& model, const ExperimentSettings& settings) override {
    const Recording still =
        simulate(model, still_states(usual_view(model), kFramesBefore + kFramesAfter),
                 read_scene(find_scene("room")), settings);
    std::vector<KidnapRun> runs;
    Progress progress("kidnap " + model.tree.name, static_cast<std::size_t>(2 * runs_),
                      settings.quiet, "runs");
    for (int number = 0; number < runs_; ++number) {
      runs.push_back(run_covered(model, number, settings));
      runs.push_back(run_thrown(model, still, number, settings.seed));
      progress.update(runs.size(), to_string(runs.back().frames.back().status));
    }
    progress.finish();
    for (const char* kind : {"covered", "thrown"}) print_summary(kind, runs);
    const auto stem = settings.output / ("kidnap_" + model.tree.name);
    write_table(stem.string() + ".csv", rows_of(runs));
    draw(stem, {model.tree.name + ": error after it was lost",
                {error_panel("covered", runs), error_panel("thrown", runs)}});
    return true;
  }

  int runs_ = 20;
};

}  // namespace

std::unique_ptr<Experiment> make_kidnap_experiment() {
  return std::make_unique<Kidnap>();
}

}  // namespace lockbox::app
