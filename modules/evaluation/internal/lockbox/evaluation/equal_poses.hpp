// SPDX-License-Identifier: BSD-3-Clause
// Poses of a model that nobody can tell apart, because it looks the same in all of them.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "lockbox/model/articulated_model.hpp"

namespace lockbox {

class EqualPoses {
 public:
  /// Makes the poses of a model that looks like itself in no other pose.
  EqualPoses() = default;

  /// Finds the poses of the model with its joints at rest, by find_symmetries(). Parts that look
  /// the same after each turn of 15 degrees about an axis count as round.
  explicit EqualPoses(const ArticulatedModel& model);

  /// Whether there is a pose that looks the same.
  bool any() const { return !turns_.empty(); }

  /// The pose T_camera_base that looks like `pose` and is nearest to `other`. Distances count as
  /// Tolerances compare them: 20 mm like 2 degrees.
  Eigen::Isometry3d nearest(const Eigen::Isometry3d& pose, const Eigen::Isometry3d& other) const;

  /// Such as "180 degrees about x", one entry an axis (of the base).
  const std::vector<std::string>& turns() const { return turns_; }

 private:
  std::vector<std::string> turns_;
  /// T_base_base, the identity among them: all, but for turns about the axes that follow.
  std::vector<Eigen::Isometry3d> motions_{Eigen::Isometry3d::Identity()};
  /// About which the model is round, in the base's frame. Two make it a ball.
  std::vector<Eigen::Vector3d> round_axes_;
  Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();  ///< all axes pass through it
};

}  // namespace lockbox
