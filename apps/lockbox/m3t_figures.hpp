// SPDX-License-Identifier: BSD-3-Clause
// What M3T (Stoiber et al., github.com/DLR-RM/3DObjectTracking, commit f021061, 2025-05-21)
// reaches on the scene of `lockbox experiment peers`: measured on this scene on one core, with
// depth alone, exact meshes, and the truth as its start. `best` has 1000 points on each part,
// search radii of 10, 5 and 3 cm and a silhouette check; `fast` the defaults of the library.
#pragma once

#include <string>
#include <vector>

namespace lockbox::app {

/// Of the magnitudes of errors; NaN where it was not recorded.
struct ErrorSpread {
  double median;
  double percentile_95;
  double maximum;
};

/// One sequence: medians over the noise seeds of what each run spreads.
struct AccuracyRow {
  std::string sequence;
  std::string tracker;
  ErrorSpread base_mm;
  ErrorSpread base_degrees;
  ErrorSpread door_degrees;
  ErrorSpread slide_mm;
};

/// Of one tracking step, milliseconds.
struct TimeRow {
  std::string tracker;
  double median_ms;
  double percentile_95_ms;  ///< NaN where it was not recorded
  double cpu_median_ms;
};

/// Percentages of trials that end near the truth.
struct CaptureRow {
  std::string kind;
  int fast;
  int best;
};

/// Every k-th frame of the sequence `moving`.
struct FastMotionRow {
  int every;
  std::string fast;
  std::string best;
};

const std::vector<AccuracyRow>& m3t_accuracy();
const std::vector<TimeRow>& m3t_times();
const std::vector<CaptureRow>& m3t_capture();
const std::vector<FastMotionRow>& m3t_fast_motion();

}  // namespace lockbox::app
