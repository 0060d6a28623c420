// SPDX-License-Identifier: BSD-3-Clause
// Motion of a model whose parts do not pass through each other.
#pragma once

#include <vector>

#include "lockbox/model/articulated_model.hpp"
#include "lockbox/simulation/trajectory.hpp"

namespace lockbox {

/// generate_trajectory, where joints wait for each other as the collision term demands.
std::vector<State> possible_motion(const ArticulatedModel& model, TrajectoryOptions options);

}  // namespace lockbox
