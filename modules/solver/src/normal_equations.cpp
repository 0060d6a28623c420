// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/solver/normal_equations.hpp"

#include "lockbox/kernels/point_to_field.hpp"

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

/// Returns the curvature that normals feign which err in any direction: sum w a a' with a = (e, p x
/// e) is, over all directions e, sum w [I, -P; P, |p|^2 I - p p'] with P = hat(p).
Matrix6 feigned_curvature(double mass, const Eigen::Vector3d& first_moment,
                          const Eigen::Matrix3d& second_moment) {
  Matrix6 result;
  result << mass * Eigen::Matrix3d::Identity(), -hat(first_moment), hat(first_moment),
      second_moment.trace() * Eigen::Matrix3d::Identity() - second_moment;
  return result;
}

}  // namespace

BodySystem to_system(const kernels::NormalSums& sums, double weight, double normal_variance) {
  BodySystem system;
  int k = 0;
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) {
      system.hessian(row, column) = system.hessian(column, row) = weight * sums.hessian[k++];
    }
    system.gradient[row] = weight * sums.gradient[row];
  }
  const double* second = sums.second_moment;
  Eigen::Matrix3d second_moment;
  second_moment << second[0], second[1], second[2], second[1], second[3], second[4], second[2],
      second[4], second[5];
  system.feigned = weight * normal_variance *
                   feigned_curvature(sums.mass, Eigen::Vector3d(sums.first_moment), second_moment);
  return system;
}

void NormalEquations::set_zero(Eigen::Index unknowns) {
  hessian.setZero(unknowns, unknowns);
  gradient.setZero(unknowns);
  information.setZero(unknowns, unknowns);
}

void NormalEquations::forget(Eigen::Index unknown) {
  information.row(unknown).setZero();
  information.col(unknown).setZero();
  gradient[unknown] = 0.0;
}

void NormalEquations::add(const BodySystem& system, const BodyJacobian& jacobian, double weight) {
  add_mapped(system.hessian, jacobian, weight, hessian);
  add_mapped(system.information(), jacobian, weight, information);
  gradient.noalias() += weight * (jacobian.transpose() * system.gradient);
}

}  // namespace lockbox
