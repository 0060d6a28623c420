// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

namespace lockbox::simulation {

/// The rigid motion that brings points nearest to where they should be: least squares over pairs
/// (Kabsch, "A solution for the best rotation to relate two sets of vectors", 1976).
class RigidFit {
 public:
  void add(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double weight) {
    weight_ += weight;
    from_ += weight * from;
    to_ += weight * to;
    products_ += weight * to * from.transpose();
  }

  /// T_to_from; the identity without any weight. Where the points lie on a line, the turn about it
  /// is any.
  Eigen::Isometry3d motion() const;

 private:
  double weight_ = 0.0;
  Eigen::Vector3d from_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d to_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d products_ = Eigen::Matrix3d::Zero();
};

}  // namespace lockbox::simulation
