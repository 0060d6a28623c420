// SPDX-License-Identifier: BSD-3-Clause
// What another tracker reaches on the scene of `lockbox experiment peers`, from a file that says
// where its figures are from (share/peers).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lockbox::app {

/// Of the magnitudes of errors; NaN where it was not recorded.
struct ErrorSummary {
  double median;
  double percentile_95;
  double maximum;
};

/// One sequence: medians over the noise seeds of the errors of each run.
struct AccuracyRow {
  std::string sequence;
  std::string tracker;
  ErrorSummary base_mm;
  ErrorSummary base_degrees;
  ErrorSummary door_degrees;
  ErrorSummary slide_mm;
};

/// Of one tracking step, milliseconds; NaN where it was not recorded.
struct TimeRow {
  std::string tracker;
  double median_ms;
  double percentile_95_ms;
  double cpu_median_ms;
};

/// Percentages of trials that end near the truth, as the file has them.
struct CaptureRow {
  std::string kind;
  std::string fast;
  std::string best;
};

/// Every k-th frame of the sequence `moving`.
struct FastMotionRow {
  int every;
  std::string fast;
  std::string best;
};

struct PublishedFigures {
  std::vector<AccuracyRow> accuracy;
  std::vector<TimeRow> times;
  std::vector<CaptureRow> capture;
  std::vector<FastMotionRow> fast_motion;
};

/// Throws InputError with file and line.
PublishedFigures read_published_figures(const std::filesystem::path& file);

}  // namespace lockbox::app
