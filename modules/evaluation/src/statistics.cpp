// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/statistics.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace lockbox {
namespace {

double percentile(const std::vector<double>& sorted, double share) {
  const double position = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], position - static_cast<double>(below));
}

}  // namespace

Statistics summarize(const std::vector<double>& errors) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  if (errors.empty()) return {0, kNan, kNan, kNan, kNan};
  std::vector<double> sorted;
  sorted.reserve(errors.size());
  double squares = 0.0;
  for (const double error : errors) {
    assert(!std::isnan(error));
    sorted.push_back(std::abs(error));
    squares += error * error;
  }
  std::sort(sorted.begin(), sorted.end());
  const double rmse = std::sqrt(squares / static_cast<double>(errors.size()));
  return {errors.size(), rmse, percentile(sorted, 0.5), percentile(sorted, 0.95), sorted.back()};
}

}  // namespace lockbox
