// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "model_extent.hpp"
#include "view_score.hpp"

namespace lockbox {

/// How closely a joint's range is looked at, of a large model (search_length).
struct ScanSteps {
  double metres;  ///< that surfaces move from one position to the next, at most
  int halvings;   ///< of the step, around the best position
};

/// For many hypotheses, and to find where joints are. Unit: metres, halvings. Source: not recorded.
/// Metres doubled, half as many positions are tried, and narrow parts are passed over.
inline constexpr ScanSteps kGlance{0.06, 0};
inline constexpr ScanSteps kScan{0.012, 2};

/// What a scan tells of each variable.
struct ScannedJoints {
  /// By how many pixels the best position explains more than any that is not beside it; infinity
  /// where nothing is seen of it.
  std::vector<double> margins;
  /// Positions that are better than those beside them, the best first, three at most.
  std::vector<std::vector<double>> peaks;
};

/// Moves one joint variable after the other, outward from the body that is held where it is, to the
/// position of its whole range that explains the view best; those that carry others together with
/// them. A variable that changes nothing in the view stays where it is. slack: metres that surfaces
/// of a large model may be off.
ScannedJoints scan_joints(const KinematicTree& tree, const ModelExtent& extent, ViewScore& score,
                          const std::vector<int>& variables, double slack, const ScanSteps& steps,
                          Configuration& configuration, std::size_t held = 0);

}  // namespace lockbox
