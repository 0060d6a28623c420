// SPDX-License-Identifier: BSD-3-Clause
// The pinhole camera that an organized cloud was seen with, and the depth image in it.
#pragma once

#include <optional>
#include <string>

#include "lockbox/core/depth_frame.hpp"
#include "pcd_component.hpp"

namespace lockbox {

/// Least squares over all points (PinholeFit); nothing if the points are too few. Throws
/// InputError(where, ...) if they do not lie on the rays of a pinhole camera.
std::optional<PinholeCamera> recover_camera(const OrganizedCloud& cloud, const std::string& where);

/// The z coordinates as a depth image: in whole millimetres if all are (to 1e-6 m), else in the
/// finest of 0.1, 0.25 and 1 mm that reaches the farthest point. Beyond reach: no measurement.
void set_depth(const OrganizedCloud& cloud, DepthFrame& frame);

/// The reverse: every pixel's point, NaN where nothing was measured.
OrganizedCloud cloud_of(const DepthFrame& frame);

}  // namespace lockbox
