// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "lockbox/capture/frame_source.hpp"
#include "lockbox/core/pinhole_camera.hpp"
#include "lockbox/publishing/publisher.hpp"
#include "lockbox/tracking/tracker.hpp"
#include "run_origin.hpp"

namespace lockbox::app {

/// All that is needed to repeat a run.
struct RunDescription {
  NamedValues origin;  ///< run_origin()
  std::filesystem::path model;
  std::string source;
  PinholeCamera camera;
  NamedValues options;     ///< of the command line, defaults included
  NamedValues parameters;  ///< of the tracker, all of them
};

/// What came of it.
class RunTotals {
 public:
  /// faults: of the source, up to this frame.
  void add(const TrackingResult& result, const SourceFaults& faults);

  std::size_t frames() const { return latencies_.size(); }
  std::size_t frames_with(TrackingStatus status) const;
  /// Returns the mean over the run, by precision. Errors repeat, so that many frames are not taken
  /// for more exact than one. Of infinite covariance if it was never measured.
  ApparentSize size() const;
  const SourceFaults& faults() const { return faults_; }
  bool ended_lost() const { return !statuses_.empty() && statuses_.back() == TrackingStatus::lost; }

  /// Milliseconds that this share of the frames does not exceed. There must be frames.
  double latency_percentile(double share) const;

 private:
  std::vector<double> latencies_;
  std::vector<TrackingStatus> statuses_;
  SourceFaults faults_;
  double frames_measured_ = 0.0;                              ///< those with a size
  Eigen::Matrix2d size_precision_ = Eigen::Matrix2d::Zero();  ///< sum over these
  Eigen::Vector2d weighted_size_ = Eigen::Vector2d::Zero();
};

/// Writes run.yaml anew: first when the run starts, then when it has ended. end: why it has.
/// seconds: wall time.
void write_run_description(const std::filesystem::path& file, const RunDescription& description,
                           const RunTotals& totals, const std::vector<Publication>& published,
                           const std::string& end, double seconds);

}  // namespace lockbox::app
