// SPDX-License-Identifier: BSD-3-Clause
// How far a body may move before it can touch another: until then nothing need be looked up.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>

#include "lockbox/sdf/signed_distance_field.hpp"

namespace lockbox {

/// Samples of one body in the field of another, at one relative pose. Within the fine grid a
/// tri-linear interpolant of distances changes by at most sqrt(3) times the way, and the fine grid
/// covers the neighbourhood of the surface: what is shown to be clear is so exactly.
class ClearWay {
 public:
  /// Nothing is known.
  ClearWay() = default;

  /// T_other_body: where the samples are looked at.
  ClearWay(const Eigen::Isometry3d& T_other_body, const SignedDistanceField& other)
      : T_other_body_(T_other_body.matrix()), way_(kReach * other.voxel()) {}

  /// A sample that is this far from touching, metres; negative: it penetrates.
  void note(float clearance) {
    way_ = std::min(way_, static_cast<double>(clearance) / kSteepest - kRounding);
  }

  /// Whether no sample can touch at another relative pose either. The samples lie in a ball of
  /// their body's frame.
  bool covers(const Eigen::Isometry3d& T_other_body, const Eigen::Vector3d& centre,
              double radius) const {
    if (way_ <= 0.0) {
      return false;
    }
    const Eigen::Matrix4d change = T_other_body.matrix() - T_other_body_;
    const Eigen::Matrix3d turn = change.topLeftCorner<3, 3>();
    const Eigen::Vector3d move = turn * centre + change.topRightCorner<3, 1>();
    return move.norm() + turn.norm() * radius < way_;
  }

 private:
  static constexpr double kReach = 2.0;      // voxels: the fine grid covers twice as many
  static constexpr double kSteepest = 1.8;   // sqrt(3), and how exact stored distances are
  static constexpr double kRounding = 2e-6;  // metres, of points in single precision

  Eigen::Matrix4d T_other_body_ = Eigen::Matrix4d::Zero();
  double way_ = 0.0;  ///< metres; 0: not clear
};

}  // namespace lockbox
