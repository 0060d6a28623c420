// SPDX-License-Identifier: BSD-3-Clause
// What is told of a result, in files as in messages.
#pragma once

#include "lockbox/tracking/tracker.hpp"

namespace lockbox {

/// Returns whether its configuration is reported, for it is `tracking` or `uncertain`.
bool is_known(const TrackingResult& result);

/// Returns the standard deviation of a joint's position, radians or metres: infinite where the view
/// does not determine it, 0 for held joints, NaN while nothing is known.
double joint_sigma(const Joint& joint, const TrackingResult& result);

}  // namespace lockbox
