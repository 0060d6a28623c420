// SPDX-License-Identifier: BSD-3-Clause
#include "overlap.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/model/moved_bodies.hpp"
#include "lockbox/model/variable_range.hpp"

namespace lockbox {
namespace {

constexpr int kSteps = 63;          // of a joint's range
constexpr double kMuchLess = 0.1;   // cost
constexpr double kInContact = 1.0;  // cost: nothing to be moved for
/// Surfaces that reach 0.14 mm into each other everywhere: no contact pressed by noise costs that.
constexpr double kOverlapping = 1000.0;

/// Returns positions of a variable's range, the nearest to where it stands first.
std::vector<double> positions_nearest_first(const KinematicTree& tree, int variable, double now) {
  std::vector<double> positions = positions_in(variable_range(tree, variable, now), kSteps);
  std::stable_sort(positions.begin(), positions.end(),
                   [now](double a, double b) { return std::abs(a - now) < std::abs(b - now); });
  return positions;
}

}  // namespace

OverlapFinder::OverlapFinder(const ArticulatedModel& model, const CollisionTerm& collision)
    : model_(model), collision_(collision) {}

bool OverlapFinder::overlaps(const Configuration& configuration, int variable) {
  return cost(configuration, moved_bodies(model_.tree, variable)) > kOverlapping;
}

Configuration OverlapFinder::with_moved(const Configuration& configuration, int variable) {
  const std::vector<std::uint8_t> moved = moved_bodies(model_.tree, variable);
  Configuration best = configuration;
  Configuration tried = configuration;
  double least = kMuchLess * cost(configuration, moved);
  for (const double position :
       positions_nearest_first(model_.tree, variable, configuration.q[variable])) {
    tried.q[variable] = position;
    const double cost_there = cost(tried, moved);
    if (cost_there >= least) continue;
    best = tried;
    least = cost_there;
    if (least < kInContact) break;
  }
  return best;
}

double OverlapFinder::cost(const Configuration& configuration,
                           const std::vector<std::uint8_t>& moved) {
  forward_kinematics(model_.tree, configuration, poses_);
  return collision_.cost_between(model_, poses_, moved);
}

}  // namespace lockbox
