// SPDX-License-Identifier: BSD-3-Clause
// How rotations are written, in files as in messages.
#pragma once

#include <Eigen/Geometry>

namespace lockbox {

/// Of the two quaternions that mean the rotation of the pose, the one whose w is not negative.
Eigen::Quaterniond told_rotation(const Eigen::Isometry3d& pose);

}  // namespace lockbox
