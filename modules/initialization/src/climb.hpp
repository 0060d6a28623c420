// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lockbox/model/articulated_model.hpp"
#include "view_score.hpp"

namespace lockbox {

/// Moves base and joints, one unknown after the other, to where the drawn model fits the view best:
/// by a few millimetres of its surfaces at first, then by ever smaller steps. What is seen beside
/// the model counts against a drawing, so that a wall just behind cannot pull it away.
void climb(const KinematicTree& tree, ViewScore& score, Configuration& configuration);

}  // namespace lockbox
