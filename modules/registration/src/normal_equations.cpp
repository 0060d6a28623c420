// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/registration/normal_equations.hpp"

namespace lockbox {

void NormalEquations::set_zero(Eigen::Index unknowns) {
  hessian.setZero(unknowns, unknowns);
  gradient.setZero(unknowns);
}

void NormalEquations::add(const BodySystem& system, const BodyJacobian& jacobian, double weight) {
  hessian.noalias() += weight * (jacobian.transpose() * system.hessian).lazyProduct(jacobian);
  gradient.noalias() += weight * jacobian.transpose() * system.gradient;
}

}  // namespace lockbox
