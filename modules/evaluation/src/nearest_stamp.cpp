// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/nearest_stamp.hpp"

#include <algorithm>
#include <cmath>

namespace lockbox {

double half_frame(const std::vector<double>& stamps) {
  if (stamps.size() < 2) return 1.0 / 60.0;
  std::vector<double> steps;
  for (std::size_t i = 1; i < stamps.size(); ++i) steps.push_back(stamps[i] - stamps[i - 1]);
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle / 2.0;
}

std::optional<std::size_t> nearest_stamp(const std::vector<double>& stamps, double time,
                                         double tolerance) {
  const auto after = std::lower_bound(stamps.begin(), stamps.end(), time);
  auto nearest = after;
  if (after == stamps.end() || (after != stamps.begin() && time - *(after - 1) <= *after - time)) {
    if (after == stamps.begin()) return std::nullopt;
    nearest = after - 1;
  }
  if (std::abs(*nearest - time) > tolerance) return std::nullopt;
  return static_cast<std::size_t>(nearest - stamps.begin());
}

}  // namespace lockbox
