// SPDX-License-Identifier: BSD-3-Clause
// A box that is turned against the camera's axes.
#pragma once

#include <Eigen/Geometry>

namespace lockbox {

/// The bounds of a body, camera frame.
struct OrientedBox {
  Eigen::Matrix3d R;  ///< its axes
  Eigen::Matrix3d R_abs;
  Eigen::Vector3d center;
  Eigen::Vector3d half;  ///< of its edges

  OrientedBox() = default;
  OrientedBox(const Eigen::AlignedBox3d& bounds, const Eigen::Isometry3d& T_camera_body)
      : R(T_camera_body.linear()),
        R_abs(R.cwiseAbs()),
        center(T_camera_body * bounds.center()),
        half(0.5 * bounds.sizes()) {}

  /// Whether a box along the camera's axes comes within gate: separating axes of both boxes' faces,
  /// so it may say yes too often but never no wrongly.
  bool may_touch(const Eigen::AlignedBox3f& other, double gate) const {
    const Eigen::Vector3d other_half = 0.5 * other.sizes().cast<double>();
    const Eigen::Vector3d own_half = half.array() + gate;
    const Eigen::Vector3d offset = other.center().cast<double>() - center;
    return (offset.cwiseAbs().array() <= (other_half + R_abs * own_half).array()).all() &&
           ((R.transpose() * offset).cwiseAbs().array() <=
            (own_half + R_abs.transpose() * other_half).array())
               .all();
  }
};

}  // namespace lockbox
