// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace lockbox {

/// Half the median distance of consecutive stamps, seconds; 1/60 if there are fewer than two.
double half_frame(const std::vector<double>& stamps);

/// Index of the stamp nearest to the given time, if it is within tolerance. Stamps increase.
std::optional<std::size_t> nearest_stamp(const std::vector<double>& stamps, double time,
                                         double tolerance);

}  // namespace lockbox
