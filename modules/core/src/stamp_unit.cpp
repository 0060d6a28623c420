// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/core/stamp_unit.hpp"

#include <algorithm>
#include <cmath>

namespace lockbox {
namespace {

// 1970 + 3170 years; in milliseconds, 1973. Doubled or halved, it still lies between the seconds
// and the milliseconds of this century.
constexpr double kFarFuture = 1e11;  // seconds

constexpr double kSlow = 5.0;           // seconds from frame to frame: no video
constexpr double kSlowest = 1000.0;     // the same in milliseconds is one frame a second
constexpr double kSlowestMicros = 2e6;  // half a frame a second

StampUnit milliseconds(bool certain) {
  return {1e3, "milliseconds", certain};
}
StampUnit microseconds() {
  return {1e6, "microseconds", true};
}
StampUnit nanoseconds() {
  return {1e9, "nanoseconds", true};
}

/// Returns the median of the steps that are greater than 0; 0 if there are fewer than two: one
/// alone may be a pause.
double median_step(const std::vector<double>& stamps) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < stamps.size(); ++i) {
    if (stamps[i] > stamps[i - 1]) {
      steps.push_back(stamps[i] - stamps[i - 1]);
    }
  }
  if (steps.size() < 2) {
    return 0.0;
  }
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>((steps.size() - 1) / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

}  // namespace

std::optional<StampUnit> other_stamp_unit(const std::vector<double>& stamps) {
  if (stamps.empty()) {
    return std::nullopt;
  }
  const double least = *std::min_element(stamps.begin(), stamps.end());
  if (least >= kFarFuture * 1e6) {
    return nanoseconds();
  }
  if (least >= kFarFuture * 1e3) {
    return microseconds();
  }
  if (least >= kFarFuture) {
    return milliseconds(true);
  }
  const double step = median_step(stamps);
  if (step >= kSlowestMicros) {
    return nanoseconds();
  }
  if (step > kSlowest) {
    return microseconds();
  }
  if (step >= kSlow) {
    return milliseconds(false);
  }
  return std::nullopt;
}

}  // namespace lockbox
