// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/model/told_rotation.hpp"

namespace lockbox {

Eigen::Quaterniond told_rotation(const Eigen::Isometry3d& pose) {
  Eigen::Quaterniond rotation(pose.linear());
  if (rotation.w() < 0.0) rotation.coeffs() *= -1.0;
  return rotation;
}

}  // namespace lockbox
