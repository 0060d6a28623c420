// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lockbox/tracking/tracker.hpp"
#include "run_description.hpp"

namespace lockbox::app {

/// Says on standard error that the object was not found, or not for certain, and what may be the
/// reason: as soon as the first search has failed, when images turn out to be mirrored or depths to
/// be in another unit, and at the end of a run that never was `tracking`. Where the object's size
/// does not fit, that is the reason, and SizeReport tells it.
class SearchReport {
 public:
  /// quiet: says it only at the end.
  explicit SearchReport(bool quiet) : is_said_(quiet), is_misreading_said_(quiet) {}

  /// Looks at it after each frame. totals: that frame included.
  void look_at(const Tracker& tracker, const DepthFrame& frame, const TrackingResult& result,
               const RunTotals& totals);

  /// Says nothing if all of it was said of the only frame.
  void print_summary(const Tracker& tracker, const RunTotals& totals) const;

 private:
  bool is_said_;
  bool is_misreading_said_;
  bool is_told_ = false;  ///< something was said, and not left out because of `quiet`
};

}  // namespace lockbox::app
