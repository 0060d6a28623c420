// SPDX-License-Identifier: BSD-3-Clause
// Ratios of the medians of one run: what holds on any machine, however busy it is.
#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <string>
#include <vector>

namespace lockbox {

/// What is printed as numerator / denominator, both names of benchmarks.
struct Ratio {
  std::string label;
  std::string numerator;
  std::string denominator;
};

/// Prints what google-benchmark prints, and at the end the ratios whose benchmarks were run: of
/// medians where there are repetitions, else of the single runs.
class RatioReporter : public benchmark::ConsoleReporter {
 public:
  explicit RatioReporter(std::vector<Ratio> ratios) : ratios_(std::move(ratios)) {}

  void ReportRuns(const std::vector<Run>& runs) override;
  void Finalize() override;

 private:
  std::vector<Ratio> ratios_;
  std::map<std::string, double> seconds_;  ///< by benchmark, an iteration
};

}  // namespace lockbox
