// SPDX-License-Identifier: BSD-3-Clause
// What the tracker made of one frame, against the truth.
#pragma once

#include <string>
#include <vector>

#include "lockbox/evaluation/status_count.hpp"
#include "lockbox/evaluation/tolerances.hpp"
#include "lockbox/model/states_file.hpp"
#include "lockbox/tracking/tracker.hpp"

namespace lockbox {

struct FrameOutcome {
  TrackingStatus status = TrackingStatus::initializing;
  int searches = 0;          ///< of TrackingResult
  double translation = 0.0;  ///< error of the base, metres; NaN while nothing is known
  double rotation = 0.0;     ///< radians
  /// The largest error of a joint that is reported observable, in units of its tolerance.
  double joints = 0.0;
  std::string worst_joint = {};  ///< whose error that is; empty if there is none

  /// Base and observable joints within the tolerances.
  bool is_right(const Tolerances& tolerances = {}) const;

  /// Returns whether it is as near as the sensor's noise lets one expect: base within 2 mm and 0.2
  /// degrees, observable joints within a fifth of their tolerance.
  bool is_at_noise_level() const;

  bool is_wrongly_trusted() const { return status == TrackingStatus::tracking && !is_right(); }
};

StatusCount count_statuses(const std::vector<FrameOutcome>& frames);

FrameOutcome compare(const KinematicTree& tree, const TrackingResult& result, const State& truth);

/// Results as a states file with the columns that `lockbox track` adds for evaluate(): status and
/// `<joint>.sigma`.
StatesFile to_states(const KinematicTree& tree, const std::vector<TrackingResult>& results);

}  // namespace lockbox
