// SPDX-License-Identifier: BSD-3-Clause
#include "search_report.hpp"

#include <iomanip>
#include <iostream>
#include <sstream>

#include "counted.hpp"
#include "lockbox/simulation/model_bounds.hpp"

namespace lockbox::app {
namespace {

std::string size_text(const KinematicTree& tree) {
  const Eigen::Vector3d size = model_bounds(tree, rest_configuration(tree)).sizes();
  std::ostringstream text;
  text << std::setprecision(3) << "The model measures " << size.x() << " x " << size.y() << " x "
       << size.z() << " m at rest: is it of that size, and in view?";
  return text.str();
}

}  // namespace

SearchReport::SearchReport(const KinematicTree& tree, double max_depth, bool quiet)
    : model_size_(size_text(tree)), survey_(max_depth), is_quiet_(quiet) {}

void SearchReport::add(const DepthFrame& frame, const TrackingResult& result) {
  was_tracked_ = was_tracked_ || result.status == TrackingStatus::tracking;
  if (was_tracked_) return;
  survey_.add(frame);
  const bool has_failed = result.searches > 0 && result.status != TrackingStatus::uncertain;
  if (!has_failed || is_quiet_) return;
  is_quiet_ = true;  // what follows from now on, the summary tells
  std::cerr << "lockbox: the object was not found up to frame " << frame.index << ": " << reasons()
            << '\n';
}

void SearchReport::print_summary(const RunTotals& totals) const {
  if (totals.frames() == 0) return;
  const bool was_there = totals.frames_with(TrackingStatus::uncertain) > 0;
  std::cerr << "lockbox: the object was " << (was_there ? "not found for certain" : "not found")
            << " in any of " << counted(totals.frames(), "frame") << ": " << reasons() << '\n';
}

std::string SearchReport::reasons() const {
  return survey_.findings() + "\n  " + model_size_;
}

}  // namespace lockbox::app
