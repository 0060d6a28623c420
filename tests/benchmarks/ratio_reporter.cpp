// SPDX-License-Identifier: BSD-3-Clause
#include "ratio_reporter.hpp"

#include <iomanip>

namespace lockbox {

void RatioReporter::ReportRuns(const std::vector<Run>& runs) {
  benchmark::ConsoleReporter::ReportRuns(runs);
  for (const Run& run : runs) {
    const bool is_median = run.aggregate_name == "median";
    const bool is_only_run = run.run_type == Run::RT_Iteration && run.repetitions == 1;
    if (is_median || is_only_run) {
      seconds_[run.run_name.function_name +
               (run.run_name.args.empty() ? "" : "/" + run.run_name.args)] =
          run.GetAdjustedRealTime() / benchmark::GetTimeUnitMultiplier(run.time_unit);
    }
  }
}

void RatioReporter::Finalize() {
  std::ostream& out = GetOutputStream();
  out << "\nRatios\n" << std::fixed << std::setprecision(2);
  for (const Ratio& ratio : ratios_) {
    const auto numerator = seconds_.find(ratio.numerator);
    const auto denominator = seconds_.find(ratio.denominator);
    if (numerator != seconds_.end() && denominator != seconds_.end()) {
      out << std::setw(10) << numerator->second / denominator->second << "  " << ratio.label
          << '\n';
    }
  }
}

}  // namespace lockbox
