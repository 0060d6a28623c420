// SPDX-License-Identifier: BSD-3-Clause
// SO(3) and SE(3): exponential, logarithm, adjoint.
//
// A twist is the 6-vector (v, w): translation first, in metres, then rotation, in radians.
// Perturbations act on the right: T <- T exp(xi), so a twist is expressed in the moving frame.
// Formulas: Sola, Deray, Atchuthan, "A micro Lie theory for state estimation in robotics" (2018).
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace lockbox {

using Twist = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Returns the cross-product matrix: hat(a) * b == a.cross(b).
Eigen::Matrix3d hat(const Eigen::Vector3d& a);

/// Returns the rotation of angle |w| about w (Sola eq. 132).
Eigen::Matrix3d exp_so3(const Eigen::Vector3d& w);

/// Returns the rotation vector of R, |w| in [0, pi] (Sola eq. 133); stable near 0 and pi.
Eigen::Vector3d log_so3(const Eigen::Matrix3d& R);

/// Returns the rigid motion of a unit time along the twist (Sola eq. 172).
Eigen::Isometry3d exp_se3(const Twist& xi);

/// Returns the twist xi with exp_se3(xi) == T (Sola eq. 173).
Twist log_se3(const Eigen::Isometry3d& T);

/// Returns the matrix with T exp(xi) T^-1 == exp(adjoint(T) xi) (Sola eq. 175, for twists with
/// translation first).
Matrix6 adjoint(const Eigen::Isometry3d& T);

/// Returns the nearest rotation to the linear part, so that products of many steps do not drift.
Eigen::Isometry3d orthonormalized(const Eigen::Isometry3d& T);

}  // namespace lockbox
