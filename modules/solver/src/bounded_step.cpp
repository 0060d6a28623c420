// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/solver/bounded_step.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lockbox {
namespace {

using Index = Eigen::Index;

constexpr double kBaseUnit = 0.25;                        // metres, and radians for its rotation
constexpr double kContinuousUnit = std::numbers::pi / 4;  // a quarter of half a turn either way
constexpr double kLeastInformation = 100.0;               // a deviation of a tenth of a unit
constexpr double kLeastSlope = 1e-12;  // cost per unit: below it a limit does not matter
constexpr double kOwnShare = 0.9;      // of a direction's square: it is this unknown's own

}  // namespace

StepScale step_scale(const KinematicTree& tree) {
  StepScale scale{Eigen::VectorXd::Constant(tree.unknowns(), kBaseUnit), kLeastInformation};
  for (int v = 0; v < tree.variables(); ++v) {
    const VariableLimits limits = variable_limits(tree, v);
    const double range = limits.upper - limits.lower;
    // A joint without room to move still needs a unit.
    scale.unit[unknown_of(v)] =
        std::isfinite(range) ? std::max(range / 4.0, 1e-3) : kContinuousUnit;
  }
  return scale;
}

const Eigen::VectorXd& BoundedStepSolver::solve(const NormalEquations& equations, double damping,
                                                const StepLimits& limits, const StepScale& scale) {
  start(equations, damping, limits);
  fix_undetermined(equations, scale);
  // Each round holds one more unknown or releases one; the bound only guards against cycling.
  const Index rounds = 4 * step_.size() + 4;
  for (Index round = 0; round < rounds; ++round) {
    solve_free(equations, scale);
    if (advance(limits) && !release(equations, limits, scale)) {
      break;
    }
  }
  return step_;
}

void BoundedStepSolver::start(const NormalEquations& equations, double damping,
                              const StepLimits& limits) {
  const Index n = equations.gradient.size();
  hessian_ = equations.hessian;
  hessian_.diagonal() *= 1.0 + damping;
  step_.setZero(n);
  held_.resize(static_cast<std::size_t>(n));
  for (Index i = 0; i < n; ++i) {
    held_[static_cast<std::size_t>(i)] = limits.lower[i] >= limits.upper[i];
  }
  fixed_ = held_;
}

/// The information over the free unknowns, in units of the scale and relative to what is enough.
/// True if there is enough in all directions.
bool BoundedStepSolver::scale_information(const NormalEquations& equations,
                                          const StepScale& scale) {
  unit_ = scale.unit;
  for (Index i = 0; i < unit_.size(); ++i) {
    if (is_held(i)) {
      unit_[i] = 0.0;
    }
  }
  information_ = unit_.asDiagonal() * equations.information * unit_.asDiagonal();
  for (Index i = 0; i < unit_.size(); ++i) {
    if (is_held(i)) {  // never in the way: decoupled, and strong
      information_(i, i) = 2.0 * scale.least_information + 1.0;
    }
  }
  information_.diagonal().array() -= scale.least_information;
  definite_.compute(information_);
  return definite_.info() == Eigen::Success;
}

/// A smooth disk's angle would follow each step of its neighbours by whatever its facets couple it
/// to them.
void BoundedStepSolver::fix_undetermined(const NormalEquations& equations, const StepScale& scale) {
  if (scale_information(equations, scale)) {
    return;
  }
  modes_.compute(information_);
  for (Index k = 0; k < step_.size() && modes_.eigenvalues()[k] <= 0.0; ++k) {
    Index own = 0;
    const double largest = modes_.eigenvectors().col(k).cwiseAbs().maxCoeff(&own);
    if (largest * largest > kOwnShare) {
      hold(own);
    }
  }
  fixed_ = held_;
}

/// Solves H s = -g over the free unknowns, the others staying where they are.
void BoundedStepSolver::solve_free(const NormalEquations& equations, const StepScale& scale) {
  const bool all_strong = scale_information(equations, scale);
  const Index n = step_.size();
  trial_.setZero(n);
  scaled_ = unit_.asDiagonal() * hessian_ * unit_.asDiagonal();
  for (Index i = 0; i < n; ++i) {
    if (is_held(i)) {
      trial_[i] = step_[i];
      scaled_(i, i) = 1.0;
    }
  }
  slope_ = equations.gradient;
  slope_.noalias() += hessian_ * trial_;
  right_ = -unit_.cwiseProduct(slope_);
  if (all_strong) {
    factors_.compute(scaled_);
    solution_ = factors_.solve(right_);
  } else {
    solve_strong_directions();
  }
  for (Index i = 0; i < n; ++i) {
    if (unit_[i] > 0.0) {
      trial_[i] = unit_[i] * solution_[i];
    }
  }
}

/// The best step within the span of the eigenvectors about which there is enough information.
void BoundedStepSolver::solve_strong_directions() {
  modes_.compute(information_);
  const Index n = right_.size();
  strong_ = modes_.eigenvectors();
  for (Index k = 0; k < n; ++k) {
    if (!(modes_.eigenvalues()[k] > 0.0)) {
      strong_.col(k).setZero();
    }
  }
  product_.noalias() = scaled_ * strong_;
  information_.noalias() = strong_.transpose() * product_;
  for (Index k = 0; k < n; ++k) {
    if (!(modes_.eigenvalues()[k] > 0.0)) {
      information_(k, k) = 1.0;
    }
  }
  slope_.noalias() = strong_.transpose() * right_;
  factors_.compute(information_);
  solution_ = factors_.solve(slope_);
  slope_.noalias() = strong_ * solution_;
  solution_ = slope_;
}

/// Goes as far towards the trial as the limits allow; false if one was met, and holds it.
bool BoundedStepSolver::advance(const StepLimits& limits) {
  double share = 1.0;
  Index blocking = -1;
  for (Index i = 0; i < step_.size(); ++i) {
    const double move = trial_[i] - step_[i];
    const double room = (move > 0.0 ? limits.upper[i] : limits.lower[i]) - step_[i];
    if (!is_held(i) && std::abs(move) > std::abs(room) && room / move < share) {
      share = std::max(0.0, room / move);
      blocking = i;
    }
  }
  if (blocking < 0) {
    step_ = trial_;
    return true;
  }
  const double limit =
      trial_[blocking] > step_[blocking] ? limits.upper[blocking] : limits.lower[blocking];
  step_ += share * (trial_ - step_);
  step_[blocking] = limit;
  hold(blocking);
  return false;
}

/// Frees the held unknown that the cost pulls back inside most strongly; false if there is none.
bool BoundedStepSolver::release(const NormalEquations& equations, const StepLimits& limits,
                                const StepScale& scale) {
  slope_ = equations.gradient;
  slope_.noalias() += hessian_ * step_;
  Index released = -1;
  double strongest = kLeastSlope;
  for (Index i = 0; i < step_.size(); ++i) {
    if (!is_held(i) || fixed_[static_cast<std::size_t>(i)]) {
      continue;
    }
    const double inward = step_[i] <= limits.lower[i] ? -slope_[i] : slope_[i];
    if (inward * scale.unit[i] > strongest) {
      strongest = inward * scale.unit[i];
      released = i;
    }
  }
  if (released >= 0) {
    held_[static_cast<std::size_t>(released)] = false;
  }
  return released >= 0;
}

}  // namespace lockbox
