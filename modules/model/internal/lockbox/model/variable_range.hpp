// SPDX-License-Identifier: BSD-3-Clause
// All that a joint variable can be, for those who try one position after the other.
#pragma once

#include <vector>

#include "lockbox/model/kinematic_tree.hpp"

namespace lockbox {

/// From limit to limit; of a variable without limits, a whole turn, both ends of which are the same
/// position. Radians or metres.
struct VariableRange {
  double lower;
  double upper;
  bool is_turn;

  double extent() const { return upper - lower; }
};

/// A turn is half a turn either way of `around`.
VariableRange variable_range(const KinematicTree& tree, int variable, double around = 0.0);

/// Returns how many steps of at most that size make up the extent, in the same unit, but no fewer
/// and no more than given. Limits may be as far apart as numbers go: no integer need count the
/// steps.
int step_count(double extent, double step, int fewest, int most);

/// Equally far from each other, from the lower end to the upper one, which of a turn is left out.
/// steps: at least one.
std::vector<double> positions_in(const VariableRange& range, int steps);

}  // namespace lockbox
