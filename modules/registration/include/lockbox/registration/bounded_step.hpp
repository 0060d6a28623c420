// SPDX-License-Identifier: BSD-3-Clause
// The step that minimises a quadratic model of the cost, within limits, and only along directions
// about which the data says something.
#pragma once

#include <Eigen/Core>

#include "lockbox/registration/normal_equations.hpp"

namespace lockbox {

struct StepLimits {
  Eigen::VectorXd lower;  ///< by unknown; lower == upper == 0 holds the unknown
  Eigen::VectorXd upper;
};

struct StepScale {
  Eigen::VectorXd unit;      ///< by unknown: a change that matters, metres or radians
  double least_information;  ///< curvature per unit^2 below which a direction is left alone
};

/// Minimises gradient.s + s' (hessian + damping diag(hessian)) s / 2 for lower <= s <= upper, by an
/// active-set method: an unknown that meets its limit leaves the solve and returns if the gradient
/// pulls it back. Directions whose curvature, in the given units, is too small get no step.
Eigen::VectorXd bounded_step(const NormalEquations& equations, double damping,
                             const StepLimits& limits, const StepScale& scale);

}  // namespace lockbox
