// SPDX-License-Identifier: BSD-3-Clause
// Quadratic approximations of costs: of one body in its own twist, and of the whole configuration.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "lockbox/core/lie.hpp"
#include "lockbox/model/forward_kinematics.hpp"

namespace lockbox {

/// Cost as a function of one body's twist xi (body frame): cost + gradient.xi + xi' hessian xi / 2.
struct BodySystem {
  Matrix6 hessian = Matrix6::Zero();
  Twist gradient = Twist::Zero();
  /// What the hessian would be if each point's normal pointed every way: sum w M(p) M(p)'.
  Matrix6 leverage = Matrix6::Zero();

  BodySystem& operator+=(const BodySystem& other) {
    hessian += other.hessian;
    gradient += other.gradient;
    leverage += other.leverage;
    return *this;
  }

  /// Adds the leverage of points around p (body frame) whose weights sum to weight.
  void add_leverage(const Eigen::Vector3d& p, double weight);

  /// The curvature less what wrong normals could feign. A disk that turns about its axis slides
  /// along itself; facets and the field's cells tilt its normals, and thousands of points would
  /// make of that an angle, known to a degree.
  Matrix6 information() const;
};

/// What one tile of the image has to say about one body.
struct TileSystem {
  std::size_t tile;
  int body;
  Matrix6 hessian;
  Twist gradient;
};

/// The same for a step (base twist, joint variables).
struct NormalEquations {
  Eigen::MatrixXd hessian;
  Eigen::VectorXd gradient;
  Eigen::MatrixXd information;

  void set_zero(Eigen::Index unknowns);

  /// Adds a body's (or a relative) system through its Jacobian, 6 x unknowns.
  void add(const BodySystem& system, const BodyJacobian& jacobian, double weight = 1.0);
};

}  // namespace lockbox
