// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/core/lie.hpp"

#include <cmath>

namespace lockbox {
namespace {

constexpr double kSmallAngle = 1e-5;  // below it the series are exact to double precision

/// V(w) of exp((v, w)) = (V v, exp w): the left Jacobian of SO(3) (Sola eq. 174).
Eigen::Matrix3d left_jacobian_so3(const Eigen::Vector3d& w) {
  const double angle = w.norm();
  const Eigen::Matrix3d W = hat(w);
  if (angle < kSmallAngle) {
    return Eigen::Matrix3d::Identity() + 0.5 * W + W * W / 6.0;
  }
  const double angle2 = angle * angle;
  return Eigen::Matrix3d::Identity() + (1.0 - std::cos(angle)) / angle2 * W +
         (angle - std::sin(angle)) / (angle2 * angle) * W * W;
}

}  // namespace

Eigen::Matrix3d hat(const Eigen::Vector3d& a) {
  Eigen::Matrix3d A;
  A << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return A;
}

Eigen::Matrix3d exp_so3(const Eigen::Vector3d& w) {
  const double angle = w.norm();
  if (angle < kSmallAngle) {
    const Eigen::Matrix3d W = hat(w);
    return Eigen::Matrix3d::Identity() + W + 0.5 * W * W;
  }
  return Eigen::AngleAxisd(angle, w / angle).toRotationMatrix();
}

Eigen::Vector3d log_so3(const Eigen::Matrix3d& R) {
  Eigen::Quaterniond q(R);
  if (q.w() < 0.0) {
    q.coeffs() = -q.coeffs();
  }
  const double sine_half = q.vec().norm();
  if (sine_half < kSmallAngle) {
    return 2.0 * q.vec();  // cos(angle / 2) = 1 to double precision
  }
  return 2.0 * std::atan2(sine_half, q.w()) / sine_half * q.vec();
}

Eigen::Isometry3d exp_se3(const Twist& xi) {
  const Eigen::Vector3d w = xi.tail<3>();
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = exp_so3(w);
  T.translation() = left_jacobian_so3(w) * xi.head<3>();
  return T;
}

Twist log_se3(const Eigen::Isometry3d& T) {
  Twist xi;
  const Eigen::Vector3d w = log_so3(T.linear());
  xi.tail<3>() = w;
  xi.head<3>() = left_jacobian_so3(w).partialPivLu().solve(T.translation());
  return xi;
}

Matrix6 adjoint(const Eigen::Isometry3d& T) {
  Matrix6 A = Matrix6::Zero();
  A.topLeftCorner<3, 3>() = T.linear();
  A.topRightCorner<3, 3>() = hat(T.translation()) * T.linear();
  A.bottomRightCorner<3, 3>() = T.linear();
  return A;
}

Eigen::Isometry3d orthonormalized(const Eigen::Isometry3d& T) {
  Eigen::Isometry3d result = T;
  result.linear() = Eigen::Quaterniond(T.linear()).normalized().toRotationMatrix();
  return result;
}

}  // namespace lockbox
