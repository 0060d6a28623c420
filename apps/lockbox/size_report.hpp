// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>
#include <string>

#include "lockbox/tracking/tracker.hpp"
#include "run_description.hpp"

namespace lockbox::app {

/// "the object looks 5.0 % (+- 0.2) larger than its model: ...", and what may be wrong, in a line.
std::string size_sentence(const ApparentSize& size);

/// Says on standard error, once, that the object's size does not fit, and what may be wrong.
class SizeReport {
 public:
  /// quiet: says nothing.
  explicit SizeReport(bool quiet) : is_said_(quiet) {}

  /// Looks at it after each frame.
  void look_at(const TrackingResult& result);

  /// How large the object looked over the run, if it was not the size of its model.
  static void print_summary(std::ostream& out, const RunTotals& totals);

 private:
  bool is_said_;
};

}  // namespace lockbox::app
