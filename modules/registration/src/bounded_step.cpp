// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/registration/bounded_step.hpp"

#include <algorithm>
#include <cmath>

namespace lockbox {
namespace {

using Index = Eigen::Index;

constexpr double kLeastSlope = 1e-12;  // cost per unit: below it a limit does not matter

}  // namespace

const Eigen::VectorXd& BoundedStepSolver::solve(const NormalEquations& equations, double damping,
                                                const StepLimits& limits, const StepScale& scale) {
  start(equations, damping, limits);
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
}

/// Solves H s = -g over the free unknowns, the others staying where they are.
void BoundedStepSolver::solve_free(const NormalEquations& equations, const StepScale& scale) {
  const Index n = step_.size();
  unit_ = scale.unit;
  trial_.setZero(n);
  for (Index i = 0; i < n; ++i) {
    if (held_[static_cast<std::size_t>(i)]) {
      unit_[i] = 0.0;
      trial_[i] = step_[i];
    }
  }
  slope_ = equations.gradient;
  slope_.noalias() += hessian_ * trial_;
  right_ = -unit_.cwiseProduct(slope_);
  scaled_ = unit_.asDiagonal() * hessian_ * unit_.asDiagonal();
  information_ = unit_.asDiagonal() * equations.information * unit_.asDiagonal();
  for (Index i = 0; i < n; ++i) {
    if (unit_[i] == 0.0) {  // never in the way: decoupled, and strong
      scaled_(i, i) = 1.0;
      information_(i, i) = 2.0 * scale.least_information + 1.0;
    }
  }
  // All directions are strong where the information exceeds the threshold as a matrix.
  information_.diagonal().array() -= scale.least_information;
  definite_.compute(information_);
  if (definite_.info() == Eigen::Success) {
    factors_.compute(scaled_);
    solution_ = factors_.solve(right_);
  } else {
    solve_strong_directions(0.0);
  }
  for (Index i = 0; i < n; ++i) {
    if (unit_[i] > 0.0) {
      trial_[i] = unit_[i] * solution_[i];
    }
  }
}

/// The best step within the span of the eigenvectors whose information exceeds the threshold.
void BoundedStepSolver::solve_strong_directions(double least_information) {
  modes_.compute(information_);
  const Index n = right_.size();
  strong_ = modes_.eigenvectors();
  for (Index k = 0; k < n; ++k) {
    if (!(modes_.eigenvalues()[k] > least_information)) {
      strong_.col(k).setZero();
    }
  }
  product_.noalias() = scaled_ * strong_;
  information_.noalias() = strong_.transpose() * product_;
  for (Index k = 0; k < n; ++k) {
    if (!(modes_.eigenvalues()[k] > least_information)) {
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
    if (!held_[static_cast<std::size_t>(i)] && std::abs(move) > std::abs(room) &&
        room / move < share) {
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
  held_[static_cast<std::size_t>(blocking)] = true;
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
    if (!held_[static_cast<std::size_t>(i)] || limits.lower[i] >= limits.upper[i]) {
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
