// SPDX-License-Identifier: BSD-3-Clause
// Depths that are in another unit than the one in force.
#pragma once

#include <optional>
#include <string>

#include "lockbox/core/depth_frame.hpp"
#include "pcd_component.hpp"

namespace lockbox {

/// What speaks against units_per_metre, and the --depth-scale that would be plausible: half of the
/// image nearer or farther than depth cameras see, or, where nobody has given the scale, steps of
/// 5 or 10 units, as only images converted to finer units have them. Nothing if the image has few
/// depths.
std::optional<std::string> doubtful_depth_scale(const DepthFrame& frame, double units_per_metre,
                                                bool is_given);

/// Half of the cloud's points are farther than depth cameras see.
struct CloudScaleDoubt {
  std::string text;      ///< what speaks against units_per_metre, and what to do
  bool is_out_of_reach;  ///< nor can depth images hold so far a point
};

std::optional<CloudScaleDoubt> doubtful_cloud_scale(const OrganizedCloud& cloud,
                                                    double units_per_metre);

}  // namespace lockbox
