// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include "lockbox/kernels/point_to_field.hpp"

namespace lockbox {

/// Returns the motion as the kernels take it.
inline kernels::RigidMotion to_rigid_motion(const Eigen::Isometry3d& T) {
  kernels::RigidMotion motion{};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      motion.rotation[3 * row + column] = static_cast<float>(T.linear()(row, column));
    }
    motion.translation[row] = static_cast<float>(T.translation()[row]);
  }
  return motion;
}

}  // namespace lockbox
