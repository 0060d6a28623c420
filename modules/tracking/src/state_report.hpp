// SPDX-License-Identifier: BSD-3-Clause
// What the tracker tells of a frame: the estimate, its status, how probable it is.
#pragma once

#include <vector>

#include "image_belief.hpp"
#include "lockbox/tracking/joint_sight.hpp"
#include "lockbox/tracking/tracker.hpp"
#include "verdict.hpp"

namespace lockbox {

/// Writes the result of each frame. All that is given must outlive it.
class StateReport {
 public:
  StateReport(const KinematicTree& tree, const TrackerOptions& options, ImageBelief& image_belief);

  /// What is reported.
  const TrackingResult& result() const { return result_; }

  /// Begins a frame.
  void begin(double stamp, Elapsed cloud_time);

  /// The answer of this frame, and what was concluded of it, now and in the frame before.
  /// alternatives: what the last search could not tell from it.
  void write(const Answer& answer, const Verdict& before, const Verdict& now,
             const std::vector<Alternative>& alternatives);

  /// Joints that are not in sight for long enough are not reported as known.
  void withhold_unknown(const JointSight& sight);

  /// Nothing was found in this frame; the last estimate stays.
  void write_nothing();

  /// Nothing is known, and what was reported was never sure: no estimate stays.
  void forget();

  /// Ends a frame. searches: how often the object was sought in the whole frame, up to now.
  void end(const Verdict& verdict, const ApparentSize& size, int searches, Elapsed step_time);

  /// The frame is the last one again: the estimate rests.
  void repeat(double stamp);

  /// The object is to be sought, from the next frame on.
  void restart() { result_.status = TrackingStatus::initializing; }

 private:
  void write_belief(const Answer& answer, const Verdict& before, const Verdict& now,
                    const std::vector<Alternative>& alternatives);

  const KinematicTree& tree_;
  const TrackerOptions& options_;
  ImageBelief& image_belief_;
  TrackingResult result_;
  int frames_without_belief_ = 0;  ///< since the image was asked for the belief that is reported
};

}  // namespace lockbox
