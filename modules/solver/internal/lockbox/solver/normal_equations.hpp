// SPDX-License-Identifier: BSD-3-Clause
// Quadratic approximations of costs: of one body in its own twist, and of the whole configuration.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "lockbox/core/lie.hpp"
#include "lockbox/model/forward_kinematics.hpp"

namespace lockbox {

namespace kernels {
struct NormalSums;
}

/// How wrong the normals of a field may be, squared radians: facets of round bodies, its cells.
inline constexpr double kNormalVariance = 0.05 * 0.05;

/// Cost as a function of one body's twist xi (body frame): cost + gradient.xi + xi' hessian xi / 2.
struct BodySystem {
  Matrix6 hessian = Matrix6::Zero();
  Twist gradient = Twist::Zero();
  /// The curvature that wrong normals could feign, sum w delta^2 a a' over all their directions.
  Matrix6 feigned = Matrix6::Zero();

  BodySystem& operator+=(const BodySystem& other) {
    hessian += other.hessian;
    gradient += other.gradient;
    feigned += other.feigned;
    return *this;
  }

  friend BodySystem operator*(double weight, const BodySystem& system) {
    return {weight * system.hessian, weight * system.gradient, weight * system.feigned};
  }

  /// The curvature less what wrong normals could feign. A disk that turns about its axis slides
  /// along itself; facets and the field's cells tilt its normals, and thousands of points would
  /// make of that an angle, known to a degree.
  Matrix6 information() const { return hessian - feigned; }
};

/// weight: of each residual beside that in the sums. normal_variance: squared radians that normals
/// err by, beside what the sums' moments contain.
BodySystem to_system(const kernels::NormalSums& sums, double weight, double normal_variance);

/// What one tile of the image has to say about one body.
struct TileSystem {
  std::size_t tile;
  int body;
  double pixels;        ///< that each of its residuals stands for
  Eigen::Vector3d ray;  ///< along which the camera sees the tile: a unit vector, body frame
  Matrix6 hessian;
  Twist gradient;
};

/// The same for a step (base twist, joint variables).
struct NormalEquations {
  Eigen::MatrixXd hessian;
  Eigen::VectorXd gradient;
  Eigen::MatrixXd information;

  void set_zero(Eigen::Index unknowns);

  /// The information about an unknown, and its gradient.
  void forget(Eigen::Index unknown);

  /// Adds a body's (or a relative) system through its Jacobian, 6 x unknowns.
  void add(const BodySystem& system, const BodyJacobian& jacobian, double weight = 1.0);
};

}  // namespace lockbox
