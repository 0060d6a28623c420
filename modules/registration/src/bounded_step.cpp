// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/registration/bounded_step.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <vector>

namespace lockbox {
namespace {

using Index = Eigen::Index;

/// Solves H s = -g over the free unknowns, others held at `step`, without weak directions.
void solve_free(const Eigen::MatrixXd& hessian, const Eigen::VectorXd& gradient,
                const StepScale& scale, const std::vector<Index>& free, Eigen::VectorXd& step) {
  const auto n = static_cast<Index>(free.size());
  Eigen::VectorXd held = step;
  for (const Index i : free) {
    held[i] = 0.0;
  }
  const Eigen::VectorXd pull = gradient + hessian * held;
  Eigen::MatrixXd scaled(n, n);
  Eigen::VectorXd right(n);
  for (Index r = 0; r < n; ++r) {
    const Index i = free[static_cast<std::size_t>(r)];
    right[r] = -pull[i] * scale.unit[i];
    for (Index c = 0; c < n; ++c) {
      const Index j = free[static_cast<std::size_t>(c)];
      scaled(r, c) = hessian(i, j) * scale.unit[i] * scale.unit[j];
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scaled);
  Eigen::VectorXd modes = eigen.eigenvectors().transpose() * right;
  for (Index k = 0; k < n; ++k) {
    const double information = eigen.eigenvalues()[k];
    modes[k] = information > scale.least_information ? modes[k] / information : 0.0;
  }
  const Eigen::VectorXd solution = eigen.eigenvectors() * modes;
  for (Index r = 0; r < n; ++r) {
    const Index i = free[static_cast<std::size_t>(r)];
    step[i] = solution[r] * scale.unit[i];
  }
}

}  // namespace

Eigen::VectorXd bounded_step(const NormalEquations& equations, double damping,
                             const StepLimits& limits, const StepScale& scale) {
  const Index n = equations.gradient.size();
  Eigen::MatrixXd hessian = equations.hessian;
  hessian.diagonal() *= 1.0 + damping;
  Eigen::VectorXd step = Eigen::VectorXd::Zero(n);
  std::vector<bool> held(static_cast<std::size_t>(n));
  for (Index i = 0; i < n; ++i) {
    held[static_cast<std::size_t>(i)] = limits.lower[i] >= limits.upper[i];
  }
  // Each round holds one more unknown or releases one; the bound only guards against cycling.
  for (Index round = 0; round < 4 * n + 4; ++round) {
    std::vector<Index> free;
    for (Index i = 0; i < n; ++i) {
      if (!held[static_cast<std::size_t>(i)]) {
        free.push_back(i);
      }
    }
    Eigen::VectorXd trial = step;
    if (!free.empty()) {
      solve_free(hessian, equations.gradient, scale, free, trial);
    }
    // As far towards the trial as the limits allow.
    double share = 1.0;
    Index blocking = -1;
    for (const Index i : free) {
      const double move = trial[i] - step[i];
      const double room = (move > 0.0 ? limits.upper[i] : limits.lower[i]) - step[i];
      if (std::abs(move) > std::abs(room) && std::abs(move) > 0.0 && room / move < share) {
        share = std::max(0.0, room / move);
        blocking = i;
      }
    }
    for (const Index i : free) {
      step[i] += share * (trial[i] - step[i]);
    }
    if (blocking >= 0) {
      step[blocking] =
          trial[blocking] > step[blocking] ? limits.upper[blocking] : limits.lower[blocking];
      held[static_cast<std::size_t>(blocking)] = true;
      continue;
    }
    // Does the cost pull a held unknown back inside?
    const Eigen::VectorXd slope = equations.gradient + hessian * step;
    Index released = -1;
    double strongest = 1e-12;
    for (Index i = 0; i < n; ++i) {
      if (!held[static_cast<std::size_t>(i)] || limits.lower[i] >= limits.upper[i]) {
        continue;
      }
      const double inward = step[i] <= limits.lower[i] ? -slope[i] : slope[i];
      if (inward * scale.unit[i] > strongest) {
        strongest = inward * scale.unit[i];
        released = i;
      }
    }
    if (released < 0) {
      break;
    }
    held[static_cast<std::size_t>(released)] = false;
  }
  return step;
}

}  // namespace lockbox
