// SPDX-License-Identifier: BSD-3-Clause
#include "rigid_fit.hpp"

#include <Eigen/SVD>

namespace lockbox::simulation {

Eigen::Isometry3d RigidFit::motion() const {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  if (weight_ <= 0.0) return T;
  const Eigen::Vector3d from = from_ / weight_;
  const Eigen::Vector3d to = to_ / weight_;
  const Eigen::Matrix3d covariance = products_ / weight_ - to * from.transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs = Eigen::Vector3d::Ones();
  signs.z() = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0 ? -1.0 : 1.0;
  T.linear() = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  T.translation() = to - T.linear() * from;
  return T;
}

}  // namespace lockbox::simulation
