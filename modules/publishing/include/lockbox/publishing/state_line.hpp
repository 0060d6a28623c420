// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "lockbox/tracking/tracker.hpp"

namespace lockbox {

/// Returns what a frame told, as one JSON object without an end of line; docs/run-files.md has its
/// fields, which are named as those of sensor_msgs/JointState and
/// geometry_msgs/PoseWithCovarianceStamped. frame: DepthFrame::index.
std::string state_line(const KinematicTree& tree, std::uint64_t frame,
                       const TrackingResult& result);

}  // namespace lockbox
