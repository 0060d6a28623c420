// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/model/variable_range.hpp"

#include <cmath>
#include <numbers>

#include "lockbox/model/configuration.hpp"

namespace lockbox {

VariableRange variable_range(const KinematicTree& tree, int variable, double around) {
  const VariableLimits limits = variable_limits(tree, variable);
  if (std::isfinite(limits.upper - limits.lower)) return {limits.lower, limits.upper, false};
  return {around - std::numbers::pi, around + std::numbers::pi, true};
}

int step_count(double extent, double step, int fewest, int most) {
  const double count = std::floor(extent / step) + 1.0;
  // What is no number, as where a step is nothing of nothing, counts as the most.
  return static_cast<int>(std::fmax(fewest, std::fmin(count, most)));
}

std::vector<double> positions_in(const VariableRange& range, int steps) {
  std::vector<double> positions(static_cast<std::size_t>(range.is_turn ? steps : steps + 1));
  for (std::size_t i = 0; i < positions.size(); ++i) {
    positions[i] = range.lower + range.extent() * static_cast<double>(i) / steps;
  }
  return positions;
}

}  // namespace lockbox
