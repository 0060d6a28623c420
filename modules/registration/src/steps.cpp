// SPDX-License-Identifier: BSD-3-Clause
#include "steps.hpp"

#include <algorithm>
#include <limits>

#include "lockbox/model/forward_kinematics.hpp"

namespace lockbox {

Steps::Steps(const KinematicTree& tree, const RegistrationOptions& options)
    : tree_(tree),
      gate_(options.gate),
      noise_(options.noise),
      moves_(tree),
      scale_(step_scale(tree)),
      held_(static_cast<std::size_t>(scale_.unit.size()), false) {
  std::fill_n(held_.begin(), kBaseUnknowns, options.fixed_base);
  for (int v = 0; v < tree.variables(); ++v) {
    held_[static_cast<std::size_t>(unknown_of(v))] = options.is_locked(v);
  }
}

const Eigen::VectorXd& Steps::best(const NormalEquations& equations, const Configuration& from,
                                   bool hold_joints, double damping) {
  set_limits(from, hold_joints);
  return solver_.solve(equations, damping, limits_, scale_);
}

bool Steps::add_short(const NormalEquations& equations, bool hold_joints, double farthest,
                      Configuration& from) {
  const Eigen::VectorXd& step = best(equations, from, hold_joints);
  if (!(moves_.of(step) <= farthest)) return false;
  apply_step(step, from);
  return true;
}

double Steps::farthest_refinement(const PinholeCamera& camera, const Configuration& from) const {
  return gate_ * noise_.sigma_lateral(from.T_camera_base.translation().norm(), camera.fx);
}

void Steps::set_limits(const Configuration& from, bool hold_joints) {
  constexpr double kUnlimited = std::numeric_limits<double>::infinity();
  const bool is_base_held = held_.front();
  limits_.lower.setConstant(scale_.unit.size(), is_base_held ? 0.0 : -kUnlimited);
  limits_.upper.setConstant(scale_.unit.size(), is_base_held ? 0.0 : kUnlimited);
  for (int v = 0; v < tree_.variables(); ++v) {
    const VariableLimits range = variable_limits(tree_, v);
    const double q = from.q[v];
    const bool locked = hold_joints || held_[static_cast<std::size_t>(unknown_of(v))];
    limits_.lower[unknown_of(v)] = locked ? 0.0 : std::min(0.0, range.lower - q);
    limits_.upper[unknown_of(v)] = locked ? 0.0 : std::max(0.0, range.upper - q);
  }
}

}  // namespace lockbox
