// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/registration/normal_equations.hpp"

namespace lockbox {
namespace {

/// sum += weight J' A J; products of fixed size, column by column, so that nothing is allocated.
void add_mapped(const Matrix6& A, const BodyJacobian& jacobian, double weight,
                Eigen::MatrixXd& sum) {
  for (Eigen::Index column = 0; column < jacobian.cols(); ++column) {
    const Twist image = weight * (A * jacobian.col(column));
    if (!image.isZero(0.0)) {
      sum.col(column).noalias() += jacobian.transpose() * image;
    }
  }
}

}  // namespace

/// For normals that err in any direction, sum w a a' with a = (e, p x e) is, over all directions e,
/// sum w [I, -P; P, |p|^2 I - p p'] with P = hat(p).
void BodySystem::add_feigned(double mass, const Eigen::Vector3d& first_moment,
                             const Eigen::Matrix3d& second_moment, double normal_variance) {
  const Eigen::Matrix3d P = normal_variance * hat(first_moment);
  feigned.topLeftCorner<3, 3>() += normal_variance * mass * Eigen::Matrix3d::Identity();
  feigned.topRightCorner<3, 3>() -= P;
  feigned.bottomLeftCorner<3, 3>() += P;
  feigned.bottomRightCorner<3, 3>() +=
      normal_variance * (second_moment.trace() * Eigen::Matrix3d::Identity() - second_moment);
}

void NormalEquations::set_zero(Eigen::Index unknowns) {
  hessian.setZero(unknowns, unknowns);
  gradient.setZero(unknowns);
  information.setZero(unknowns, unknowns);
}

void NormalEquations::add(const BodySystem& system, const BodyJacobian& jacobian, double weight) {
  add_mapped(system.hessian, jacobian, weight, hessian);
  add_mapped(system.information(), jacobian, weight, information);
  gradient.noalias() += weight * (jacobian.transpose() * system.gradient);
}

}  // namespace lockbox
