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

/// Equally far from each other, from the lower end to the upper one, which of a turn is left out.
/// steps: at least one.
std::vector<double> positions_in(const VariableRange& range, int steps);

}  // namespace lockbox
