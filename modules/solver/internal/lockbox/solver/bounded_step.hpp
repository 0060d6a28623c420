// SPDX-License-Identifier: BSD-3-Clause
// The step that minimises a quadratic model of the cost, within limits, and only along directions
// about which the data says something.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

#include "lockbox/model/kinematic_tree.hpp"
#include "lockbox/solver/normal_equations.hpp"
#include "lockbox/solver/symmetric_modes.hpp"

namespace lockbox {

struct StepLimits {
  Eigen::VectorXd lower;  ///< by unknown; lower == upper == 0 holds the unknown
  Eigen::VectorXd upper;
};

struct StepScale {
  Eigen::VectorXd unit;      ///< by unknown: a change that matters, metres or radians
  double least_information;  ///< information per unit^2 below which a direction is left alone
};

/// A quarter of each joint's range, and as much for the base as parts are large.
StepScale step_scale(const KinematicTree& tree);

/// Minimises gradient.s + s' (hessian + damping diag(hessian)) s / 2 for lower <= s <= upper, by an
/// active-set method: an unknown that meets its limit leaves the solve and returns if the gradient
/// pulls it back. Directions with too little information, in the given units, get no step; an
/// unknown that is such a direction by itself does not move at all.
/// Owns the memory of the solution: once used, it allocates nothing for the same number of
/// unknowns.
class BoundedStepSolver {
 public:
  /// The step is valid until the next call.
  const Eigen::VectorXd& solve(const NormalEquations& equations, double damping,
                               const StepLimits& limits, const StepScale& scale);

 private:
  void start(const NormalEquations& equations, double damping, const StepLimits& limits);
  void fix_undetermined(const NormalEquations& equations, const StepScale& scale);
  bool scale_information(const NormalEquations& equations, const StepScale& scale);
  void solve_free(const NormalEquations& equations, const StepScale& scale);
  void solve_strong_directions();
  bool advance(const StepLimits& limits);
  bool release(const NormalEquations& equations, const StepLimits& limits, const StepScale& scale);
  void hold(Eigen::Index unknown) { held_[static_cast<std::size_t>(unknown)] = true; }
  bool is_held(Eigen::Index unknown) const { return held_[static_cast<std::size_t>(unknown)]; }

  Eigen::VectorXd step_;
  Eigen::VectorXd trial_;
  Eigen::VectorXd slope_;
  Eigen::MatrixXd hessian_;  ///< damped
  std::vector<bool> held_;   ///< at a limit, or fixed
  std::vector<bool> fixed_;  ///< whatever the gradient says

  // In units of the scale; held unknowns have rows and columns of zeros.
  Eigen::VectorXd unit_;
  Eigen::MatrixXd scaled_;
  Eigen::MatrixXd information_;
  Eigen::VectorXd right_;
  Eigen::VectorXd solution_;
  // Of a matrix: without one Eigen leaves members unset, and moving them is undefined.
  Eigen::LLT<Eigen::MatrixXd> definite_{Eigen::MatrixXd(0, 0)};
  Eigen::LDLT<Eigen::MatrixXd> factors_{Eigen::MatrixXd(0, 0)};
  SymmetricModes modes_;
  Eigen::MatrixXd strong_;
  Eigen::MatrixXd product_;
};

}  // namespace lockbox
