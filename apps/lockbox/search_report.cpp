// SPDX-License-Identifier: BSD-3-Clause
#include "search_report.hpp"

#include <iostream>

#include "lockbox/tracking/search_failure.hpp"
#include "size_report.hpp"

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

const char* outcome(const TrackingResult& result, const RunTotals& totals) {
  const bool is_there = result.status == TrackingStatus::uncertain;
  if (totals.frames_with(TrackingStatus::tracking) > 0) {
    return is_there ? "lost, and not found again for certain" : "lost, and not found again";
  }
  return is_there ? "not found for certain" : "not found";
}

}  // namespace

void SearchReport::look_at(const Tracker& tracker, const DepthFrame& frame,
                           const TrackingResult& result, const RunTotals& totals) {
  if (!tracker.search_failure()) return;
  const bool is_misreading = is_misread(*tracker.search_failure());
  if (result.size.is_implausible() && !is_misreading) return;
  const bool is_news = is_misreading && !is_misreading_said_;
  if (is_said_ && !is_news) return;
  is_said_ = true;  // what follows from now on, the summary tells
  is_misreading_said_ = is_misreading_said_ || is_news;
  is_told_ = true;
  std::cerr << "lockbox: the object was " << outcome(result, totals) << " up to frame "
            << frame.index;
  print_reasons(tracker);
}

void SearchReport::print_summary(const Tracker& tracker, const RunTotals& totals) const {
  const bool is_all_said = totals.frames() == 1 && is_told_;
  if (totals.frames() == 0 || is_all_said) return;
  const bool was_there = totals.frames_with(TrackingStatus::uncertain) > 0;
  std::cerr << "lockbox: the object was " << (was_there ? "not found for certain" : "not found");
  if (totals.frames() == 1) {
    std::cerr << " in the only frame";
  } else {
    std::cerr << " in any of " << totals.frames() << " frames";
  }
  if (totals.size().is_implausible()) {
    std::cerr << ":\n  " << size_sentence(totals.size()) << '\n';
  } else {
    print_reasons(tracker);
  }
}

}  // namespace lockbox::app
