// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <utility>

#include "lockbox/capture/oni_writer.hpp"
#include "lockbox/publishing/publisher.hpp"
#include "lockbox/visualization/live_view.hpp"
#include "locked_folder.hpp"
#include "run_description.hpp"
#include "run_settings.hpp"
#include "run_writer.hpp"
#include "snapshots.hpp"

namespace lockbox::app {

/// Everything that a run writes, each part only if it was asked for.
class RunOutputs {
 public:
  /// Model, settings and publisher are referred to. Throws InputError.
  RunOutputs(const ArticulatedModel& model, RunDescription description, const RunSettings& settings,
             Publisher& publisher);

  /// source: that has delivered this frame last.
  void add(const DepthFrame& frame, const TrackingResult& result, const FrameSource& source);

  /// Sets those in force, which may have changed since the beginning.
  void set_parameters(NamedValues parameters) { description_.parameters = std::move(parameters); }

  /// end: why the run has ended.
  void finish(const std::string& end);

  /// Ends the outputs after an error, which the user has to hear of rather than of others that
  /// follow from it.
  void abandon(const std::string& end) noexcept;

  const RunTotals& totals() const { return totals_; }

 private:
  using Clock = std::chrono::steady_clock;

  void begin(const DepthFrame& frame, const std::string& file);
  void describe(const std::string& end) const;

  const RunSettings& settings_;
  const KinematicTree& tree_;
  Publisher& publisher_;
  RunDescription description_;
  RunTotals totals_;
  std::optional<LiveView> view_;  // first: without a display no file is begun
  std::optional<LockedFolder> folder_;
  std::optional<RunWriter> states_;
  std::optional<OniWriter> recording_;
  std::optional<Snapshots> snapshots_;
  Clock::time_point start_;
  double first_stamp_ = 0.0;  ///< seconds, of the first frame
};

}  // namespace lockbox::app
