// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "view_score.hpp"

namespace lockbox {

/// Moves one joint variable after the other, in the order of the tree, to the position of its whole
/// range that explains the view best. A variable that changes nothing in the view stays where it
/// is. slack: metres that surfaces may be off.
void scan_joints(const KinematicTree& tree, ViewScore& score, const std::vector<int>& variables,
                 double slack, Configuration& configuration);

/// The same by contrast, for a view of single pixels and a base that is known to a few millimetres.
void scan_joints_by_contrast(const KinematicTree& tree, ViewScore& score,
                             const std::vector<int>& variables, Configuration& configuration);

}  // namespace lockbox
