// SPDX-License-Identifier: BSD-3-Clause
// Joints held, box and camera still, the lower part of the box out of view; the start displaced
// along the box's y axis.
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <optional>

#include "command_line/option_checks.hpp"
#include "command_line/progress.hpp"
#include "command_line/shipped_files.hpp"
#include "experiments.hpp"
#include "lockbox/core/units.hpp"
#include "lockbox/evaluation/frame_outcome.hpp"
#include "lockbox/evaluation/table.hpp"

namespace lockbox::app {
namespace {

constexpr double kCentimetres = 100.0;
constexpr double kLargestStart = 0.9;  // metres
constexpr double kOutOfView = 0.42;    // how far the box hangs below the usual view, metres

struct RigidRun {
  double start;  ///< displacement, metres
  std::vector<FrameOutcome> frames;

  /// The frame from which on the error stays at noise level; none if it does not end there.
  std::optional<std::size_t> arrival() const {
    std::size_t first = frames.size();
    while (first > 0 && frames[first - 1].is_at_noise_level()) --first;
    return first < frames.size() ? std::optional(first) : std::nullopt;
  }
};

Table rows_of(const std::vector<RigidRun>& runs) {
  Table table({"start", "frame", "status", "searches", "translation", "rotation"});
  for (const RigidRun& run : runs) {
    for (std::size_t i = 0; i < run.frames.size(); ++i) {
      const FrameOutcome& frame = run.frames[i];
      table.add({run.start, i, to_string(frame.status), frame.searches, frame.translation,
                 frame.rotation});
    }
  }
  return table;
}

void print_summary(const std::vector<RigidRun>& runs) {
  std::size_t arrived = 0;
  StatusCount statuses;
  std::cout << "\nstart (cm)  end (mm, degrees)  at noise level from frame  searches\n";
  for (const RigidRun& run : runs) {
    const FrameOutcome& last = run.frames.back();
    const auto arrival = run.arrival();
    arrived += arrival ? 1U : 0U;
    statuses += count_statuses(run.frames);
    std::cout << std::fixed << std::setprecision(0) << std::setw(10) << kCentimetres * run.start
              << std::setprecision(2) << std::setw(11) << 1000.0 * last.translation << std::setw(8)
              << kDegrees * last.rotation << std::setw(27)
              << (arrival ? std::to_string(*arrival) : "never") << std::setw(10) << last.searches
              << '\n';
  }
  std::cout << "at noise level (2 mm, 0.2 degrees) at the end: " << arrived << " of " << runs.size()
            << " starts\n";
  print_status_count(statuses);
}

Figure error_figure(const std::string& name, const std::vector<RigidRun>& runs) {
  Panel translation{"frames processed", "translation error (mm)", {}, true};
  Panel rotation{"frames processed", "rotation error (degrees)", {}, true};
  for (const RigidRun& run : runs) {
    Curve moved{std::to_string(std::lround(kCentimetres * run.start)) + " cm", {}, {}};
    for (std::size_t i = 0; i <= run.frames.size(); ++i) moved.x.push_back(static_cast<double>(i));
    Curve turned = moved;
    moved.y.push_back(1000.0 * run.start);
    turned.y.push_back(std::nan(""));
    for (const FrameOutcome& frame : run.frames) {
      moved.y.push_back(1000.0 * frame.translation);
      turned.y.push_back(kDegrees * frame.rotation);
    }
    translation.curves.push_back(moved);
    rotation.curves.push_back(turned);
  }
  return {name + ", lower part out of view: error by displacement of the start",
          {translation, rotation}};
}

class Rigid : public Experiment {
 public:
  void add_options(CLI::App& options) override {
    options.add_option("--frames", frames_, "Of each run")->check(positive());
    options.add_option("--step", step_, "From one start to the next, cm")
        ->check(between(1.0, 90.0));
  }

 private:
  bool run_model(const ArticulatedModel& model, const ExperimentSettings& settings) override {
    Configuration truth = usual_view(model);
    truth.T_camera_base.translation().y() += kOutOfView;
    const Recording recording =
        simulate(model, still_states(truth, frames_), read_scene(find_scene("room")), settings);
    TrackerOptions options;
    options.registration.locked.assign(static_cast<std::size_t>(model.tree.variables()), true);
    std::vector<RigidRun> runs;
    const auto starts = static_cast<std::size_t>(kCentimetres * kLargestStart / step_ + 1.0);
    Progress progress("rigid " + model.tree.name, starts, settings.quiet, "starts");
    for (std::size_t i = 0; i < starts; ++i) {
      RigidRun run{static_cast<double>(i) * step_ / kCentimetres, {}};
      Configuration start = truth;
      start.T_camera_base.translate(Eigen::Vector3d(0.0, run.start, 0.0));
      Tracker tracker(model, options);
      tracker.start(start);
      for (const TrackingResult& result : track(tracker, recording)) {
        run.frames.push_back(compare(model.tree, result, recording.truth.front()));
      }
      runs.push_back(run);
      progress.update(i + 1, to_string(run.frames.back().status));
    }
    progress.finish();
    print_summary(runs);
    const auto stem = settings.output / ("rigid_" + model.tree.name);
    write_table(stem.string() + ".csv", rows_of(runs));
    draw(stem, error_figure(model.tree.name, runs));
    return true;
  }

  int frames_ = 93;
  double step_ = 10.0;
};

}  // namespace

std::unique_ptr<Experiment> make_rigid_experiment() {
  return std::make_unique<Rigid>();
}

}  // namespace lockbox::app
