// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "depth_survey.hpp"
#include "lockbox/model/kinematic_tree.hpp"
#include "lockbox/tracking/tracker.hpp"
#include "run_description.hpp"

namespace lockbox::app {

/// Says on standard error that the object was not found, and what may be the reason: as soon as the
/// first search has failed, and at the end of a run that never was `tracking`.
class SearchReport {
 public:
  /// max_depth: metres; the tracker drops what is measured farther. quiet: says it only at the end.
  SearchReport(const KinematicTree& tree, double max_depth, bool quiet);

  void add(const DepthFrame& frame, const TrackingResult& result);

  void print_summary(const RunTotals& totals) const;

 private:
  std::string reasons() const;

  std::string model_size_;  ///< a sentence without a full stop
  DepthSurvey survey_;      ///< of the frames before the object was tracked
  bool is_quiet_;
  bool was_tracked_ = false;
};

}  // namespace lockbox::app
