// SPDX-License-Identifier: BSD-3-Clause
#include "run_outputs.hpp"

#include <utility>

#include "lockbox/publishing/state_line.hpp"
#include "lockbox/tracking/reported.hpp"
#include "lockbox/visualization/scene_composer.hpp"

namespace lockbox::app {
namespace {

constexpr int kRecordingRate = 30;  // nominal; the stamps say when frames really came

std::vector<double> joint_sigmas(const KinematicTree& tree, const TrackingResult& result) {
  std::vector<double> sigmas;
  for (const Joint& joint : tree.joints) sigmas.push_back(joint_sigma(joint, result));
  return sigmas;
}

ShownEstimate shown(const KinematicTree& tree, const TrackingResult& result) {
  ShownEstimate estimate(result.configuration, joint_sigmas(tree, result));
  estimate.covariance = result.covariance;
  estimate.belief = belief_line(result.belief, alternatives_text(result.alternatives));
  for (const Alternative& alternative : result.alternatives) {
    estimate.alternatives.push_back(
        {alternative_name(to_string(alternative.kind), alternative.probability),
         alternative.configuration});
  }
  return estimate;
}

}  // namespace

RunOutputs::RunOutputs(const ArticulatedModel& model, RunDescription description,
                       const RunSettings& settings, Publisher& publisher)
    : settings_(settings),
      tree_(model.tree),
      publisher_(publisher),
      description_(std::move(description)),
      start_(Clock::now()) {
  if (settings.view) view_.emplace(model, description_.source);
  if (!settings.output.empty()) {
    folder_.emplace(settings.output);
    require_no_rows(settings.output, settings.overwrite);
    states_.emplace(settings.output, model.tree, settings.covariance);
  }
  if (!settings.snapshots.empty()) {
    snapshots_.emplace(settings.snapshots, model.tree, settings.snapshot_interval, Executor());
  }
}

void RunOutputs::add(const DepthFrame& frame, const TrackingResult& result,
                     const FrameSource& source) {
  if (totals_.frames() == 0) begin(frame, source.file_of_frame());
  if (!settings_.publish.empty()) publisher_.publish(state_line(tree_, frame.index, result));
  totals_.add(result, source.faults());
  if (states_) states_->write(result);
  if (recording_) recording_->write(frame, source.file_of_frame());
  if (!snapshots_ && !view_) return;
  // Cameras count from another time each.
  const double start = source.frame_count() ? 0.0 : first_stamp_;
  const std::string title = frame_title(frame.index, frame.stamp - start, to_string(result.status));
  const ShownEstimate estimate = shown(tree_, result);
  if (snapshots_) snapshots_->add(frame, estimate, title);
  if (view_) view_->show(frame, estimate, title);
}

void RunOutputs::finish(const std::string& end) {
  publisher_.close();
  describe(end);
  if (recording_) recording_->finish();
}

void RunOutputs::abandon(const std::string& end) noexcept {
  try {
    describe(end);
  } catch (const std::exception&) {
    // The description of the beginning of the run is left.
  }
}

/// What only the first frame tells.
void RunOutputs::begin(const DepthFrame& frame, const std::string& file) {
  first_stamp_ = frame.stamp;
  description_.camera = frame.camera;
  describe("still running, or ended by force");
  if (!settings_.recording.empty()) {
    recording_.emplace(settings_.recording, frame.camera, kRecordingRate, frame.metres_per_unit,
                       file);
  }
}

void RunOutputs::describe(const std::string& end) const {
  if (settings_.output.empty()) return;
  const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
  write_run_description(settings_.output / "run.yaml", description_, totals_,
                        publisher_.publications(), end, seconds);
}

}  // namespace lockbox::app
