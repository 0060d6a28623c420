// SPDX-License-Identifier: BSD-3-Clause
#include "tracking_run.hpp"

#include <algorithm>
#include <chrono>
#include <iomanip>
#include <iostream>

#include "interruption.hpp"
#include "lockbox/capture/oni_writer.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/visualization/live_view.hpp"
#include "lockbox/visualization/scene_composer.hpp"
#include "progress.hpp"
#include "run_writer.hpp"
#include "snapshots.hpp"

namespace lockbox::app {
namespace {

constexpr int kRecordingRate = 30;  // nominal; the stamps say when frames really came

/// Everything that a run writes, each part only if it was asked for.
class Outputs {
 public:
  Outputs(const ArticulatedModel& model, RunDescription description, const RunSettings& settings)
      : settings_(settings), description_(std::move(description)), start_(Clock::now()) {
    if (settings.view) view_.emplace(model);  // first: without a display no file is begun
    if (!settings.output.empty()) {
      states_.emplace(settings.output, model.tree, settings.covariance);
    }
    if (!settings.snapshots.empty()) {
      snapshots_.emplace(settings.snapshots, model.tree, settings.snapshot_interval, Executor());
    }
  }

  void add(const DepthFrame& frame, const TrackingResult& result) {
    if (totals_.frames() == 0) begin(frame);
    totals_.add(result);
    if (states_) states_->write(result);
    if (recording_) recording_->write(frame);
    if (snapshots_) snapshots_->add(frame, result.configuration);
    if (view_) {
      view_->show(frame, result.configuration,
                  frame_title(frame.index, frame.stamp, to_string(result.status)));
    }
  }

  void finish(RunEnd end) {
    describe(end);
    if (recording_) recording_->finish();
  }

  /// After an error, which the user has to hear of rather than of others that follow from it.
  void abandon() noexcept {
    try {
      describe(RunEnd::failed);
    } catch (const std::exception&) {
      // The description of the beginning of the run is left.
    }
  }

  const RunTotals& totals() const { return totals_; }

 private:
  using Clock = std::chrono::steady_clock;

  /// What only the first frame tells.
  void begin(const DepthFrame& frame) {
    description_.camera = frame.camera;
    describe(RunEnd::still_running);
    if (!settings_.recording.empty()) {
      recording_.emplace(settings_.recording, frame.camera, kRecordingRate, frame.metres_per_unit);
    }
  }

  void describe(RunEnd end) const {
    if (settings_.output.empty()) return;
    const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
    write_run_description(settings_.output / "run.yaml", description_, totals_, end, seconds);
  }

  const RunSettings& settings_;
  RunDescription description_;
  RunTotals totals_;
  std::optional<RunWriter> states_;
  std::optional<OniWriter> recording_;
  std::optional<Snapshots> snapshots_;
  std::optional<LiveView> view_;
  Clock::time_point start_;
};

/// Number of frames that a run will have, if that is known.
std::optional<std::size_t> expected_frames(const FrameSource& source, const RunSettings& settings) {
  const auto available = source.frame_count();
  if (settings.max_frames == 0) return available;
  return std::min(settings.max_frames, available.value_or(settings.max_frames));
}

RunEnd track_all(FrameSource& source, Tracker& tracker, const RunSettings& settings,
                 const Interruption& interruption, Outputs& outputs) {
  Progress progress("track", expected_frames(source, settings), settings.quiet);
  DepthFrame frame;
  RunEnd end = RunEnd::end_of_source;
  while (source.next(frame)) {
    const TrackingResult& result = tracker.process(frame);
    outputs.add(frame, result);
    progress.update(outputs.totals().frames(), to_string(result.status));
    if (interruption.requested()) {
      end = RunEnd::interrupted;
      break;
    }
    if (outputs.totals().frames() == settings.max_frames) {
      end = RunEnd::frame_limit;
      break;
    }
  }
  progress.finish();
  return end;
}

void print_summary(const RunTotals& totals, const RunSettings& settings) {
  std::cout << totals.frames() << " frames";
  for (const auto status : {TrackingStatus::initializing, TrackingStatus::tracking,
                            TrackingStatus::uncertain, TrackingStatus::lost}) {
    if (totals.frames_with(status) > 0) {
      std::cout << ", " << totals.frames_with(status) << ' ' << to_string(status);
    }
  }
  std::cout << std::fixed << std::setprecision(1) << "; latency " << totals.latency_percentile(0.5)
            << " ms (median), " << totals.latency_percentile(0.95) << " ms (95 %)\n";
  if (!settings.output.empty()) std::cout << "results: " << settings.output.string() << '\n';
}

}  // namespace

ExitStatus track_source(FrameSource& source, Tracker& tracker, const ArticulatedModel& model,
                        RunDescription description, const RunSettings& settings) {
  Outputs outputs(model, std::move(description), settings);
  const Interruption interruption;
  RunEnd end = RunEnd::failed;
  try {
    end = track_all(source, tracker, settings, interruption, outputs);
  } catch (...) {
    outputs.abandon();
    throw;
  }
  outputs.finish(end);
  if (outputs.totals().frames() == 0 && end != RunEnd::interrupted) {
    throw InputError(source.description(), "delivered no frame");
  }
  if (!settings.quiet) print_summary(outputs.totals(), settings);
  return outputs.totals().ended_lost() ? ExitStatus::lost : ExitStatus::done;
}

}  // namespace lockbox::app
