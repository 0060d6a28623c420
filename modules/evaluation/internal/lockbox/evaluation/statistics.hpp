// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace lockbox {

/// Of the magnitudes of errors, in their unit. All NaN if count is 0.
struct Statistics {
  std::size_t count = 0;
  double rmse;
  double median;
  double percentile_95;
  double maximum;
};

/// Percentiles are interpolated linearly between the sorted magnitudes. NaN errors are refused by
/// assertion: leave them out.
Statistics summarize(const std::vector<double>& errors);

}  // namespace lockbox
