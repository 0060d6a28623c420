// SPDX-License-Identifier: BSD-3-Clause
#include "search_report.hpp"

#include <iostream>

#include "counted.hpp"
#include "lockbox/tracking/search_failure.hpp"

namespace lockbox::app {
namespace {

/// One a line, if the tracker knows any.
void print_reasons(const Tracker& tracker) {
  std::cerr << (tracker.search_failure() ? ":\n" : "\n");
  if (!tracker.search_failure()) return;
  for (const std::string& reason : reasons(*tracker.search_failure())) {
    std::cerr << "  " << reason << '\n';
  }
}

bool is_misread(const SearchFailure& failure) {
  return failure.is_mirrored || failure.depth_factor != 1.0;
}

}  // namespace

void SearchReport::look_at(const Tracker& tracker, const DepthFrame& frame,
                           const RunTotals& totals) {
  if (!tracker.search_failure()) return;
  const bool is_news = is_misread(*tracker.search_failure()) && !is_misreading_said_;
  if (is_said_ && !is_news) return;
  is_said_ = true;  // what follows from now on, the summary tells
  is_misreading_said_ = is_misreading_said_ || is_news;
  const bool was_found = totals.frames_with(TrackingStatus::tracking) > 0;
  std::cerr << "lockbox: the object was " << (was_found ? "lost, and not found again" : "not found")
            << " up to frame " << frame.index;
  print_reasons(tracker);
}

void SearchReport::print_summary(const Tracker& tracker, const RunTotals& totals) {
  if (totals.frames() == 0) return;
  const bool was_there = totals.frames_with(TrackingStatus::uncertain) > 0;
  std::cerr << "lockbox: the object was " << (was_there ? "not found for certain" : "not found")
            << " in any of " << counted(totals.frames(), "frame");
  print_reasons(tracker);
}

}  // namespace lockbox::app
