// SPDX-License-Identifier: BSD-3-Clause
#include "joint_scan.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "levers.hpp"

namespace lockbox {
namespace {

constexpr int kMostPositions = 64;
constexpr double kLeastGain = 1.0;        // pixels: worth moving for
constexpr double kHardlyStandsOut = 4.0;  // standard deviations of a depth

std::vector<double> positions_between(double lower, double upper, int count) {
  std::vector<double> positions;
  positions.reserve(static_cast<std::size_t>(std::max(0, count)) +
                    1);  // one is added by the caller
  for (int i = 0; i < count; ++i) {
    positions.push_back(lower + (upper - lower) * i / std::max(1, count - 1));
  }
  return positions;
}

void scan_variable(const KinematicTree& tree, ViewScore& score, int variable, double lever,
                   double slack, const ScanSteps& steps, Configuration& configuration) {
  const VariableLimits limits = variable_limits(tree, variable);
  const bool limited = std::isfinite(limits.upper - limits.lower);
  double lower = limited ? limits.lower : configuration.q[variable] - std::numbers::pi;
  double upper = limited ? limits.upper : configuration.q[variable] + std::numbers::pi;
  const double reach = (upper - lower) * lever;
  if (!(reach > 0.0)) return;
  int count = std::clamp(static_cast<int>(reach / steps.metres) + 2, 3, kMostPositions);
  const double start = configuration.q[variable];
  double best_gain = kLeastGain;
  double step = (upper - lower) / (count - 1);
  for (int level = 0; level <= steps.halvings; ++level) {
    std::vector<double> positions = positions_between(lower, upper, count);
    positions.push_back(start);
    const std::vector<double> scores = score.scan(configuration, variable, positions, slack);
    const auto best = std::max_element(scores.begin(), scores.end() - 1);
    const double gain = *best - scores.back();
    if (gain > best_gain) {
      best_gain = gain;
      configuration.q[variable] = positions[static_cast<std::size_t>(best - scores.begin())];
    }
    step *= 0.5;
    lower = std::max(limits.lower, configuration.q[variable] - step);
    upper = std::min(limits.upper, configuration.q[variable] + step);
    count = 3;
  }
}

}  // namespace

void scan_joints(const KinematicTree& tree, ViewScore& score, const std::vector<int>& variables,
                 double slack, const ScanSteps& steps, Configuration& configuration) {
  const ModelLevers levers = model_levers(tree);
  for (const int variable : variables) {
    scan_variable(tree, score, variable, levers.variables[variable], slack, steps, configuration);
  }
}

void scan_low_relief(LowRelief& low_relief, const TiledCloud& cloud,
                     const std::vector<int>& variables, Configuration& configuration) {
  for (const int variable : variables) {
    if (low_relief.prominence(variable, configuration) > kHardlyStandsOut) continue;
    const auto sighting = low_relief.find_anywhere(cloud, configuration, variable);
    if (sighting) configuration.q[variable] = sighting->position;
  }
}

}  // namespace lockbox
