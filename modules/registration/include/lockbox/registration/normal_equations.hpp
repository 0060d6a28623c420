// SPDX-License-Identifier: BSD-3-Clause
// Quadratic approximations of costs: of one body in its own twist, and of the whole configuration.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lockbox/core/lie.hpp"
#include "lockbox/model/forward_kinematics.hpp"

namespace lockbox {

/// Cost as a function of one body's twist xi (body frame): cost + gradient.xi + xi' hessian xi / 2.
struct BodySystem {
  Matrix6 hessian = Matrix6::Zero();
  Twist gradient = Twist::Zero();

  BodySystem& operator+=(const BodySystem& other) {
    hessian += other.hessian;
    gradient += other.gradient;
    return *this;
  }
};

/// The same for a step (base twist, joint variables).
struct NormalEquations {
  Eigen::MatrixXd hessian;
  Eigen::VectorXd gradient;

  void set_zero(Eigen::Index unknowns);

  /// Adds a body's (or a relative) system through its Jacobian, 6 x unknowns.
  void add(const BodySystem& system, const BodyJacobian& jacobian, double weight = 1.0);
};

}  // namespace lockbox
