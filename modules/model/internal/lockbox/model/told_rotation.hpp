// SPDX-License-Identifier: BSD-3-Clause
// How rotations are written, in files as in messages.
#pragma once

#include <Eigen/Geometry>

namespace lockbox {

/// Returns the one of the two quaternions of the pose's rotation whose w is not negative.
Eigen::Quaterniond told_rotation(const Eigen::Isometry3d& pose);

}  // namespace lockbox
