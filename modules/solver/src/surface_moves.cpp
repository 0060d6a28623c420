// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/solver/surface_moves.hpp"

#include <algorithm>
#include <cmath>

#include "lockbox/model/surface_levers.hpp"

namespace lockbox {
namespace {

using Index = Eigen::Index;

constexpr double kSignificant = 2.0;  // standard deviations: more than noise mostly moves

}  // namespace

SurfaceMoves::SurfaceMoves(const KinematicTree& tree) : levers_(surface_levers(tree)) {}

double SurfaceMoves::between(const Configuration& a, const Configuration& b) const {
  double farthest = of_base(log_se3(a.T_camera_base.inverse() * b.T_camera_base));
  for (Index v = 0; v < a.q.size(); ++v) {
    farthest = std::max(farthest, std::abs(b.q[v] - a.q[v]) * levers_[6 + v]);
  }
  return farthest;
}

double SurfaceMoves::of(const Eigen::VectorXd& step) const {
  double farthest = of_base(step.head<6>());
  for (Index i = 6; i < step.size(); ++i) {
    farthest = std::max(farthest, std::abs(step[i]) * levers_[i]);
  }
  return farthest;
}

double SurfaceMoves::of_significant(const Eigen::VectorXd& step,
                                    const std::vector<bool>& observable,
                                    const Eigen::VectorXd& sigma) const {
  const auto is_significant = [&](Index i) {
    return observable[static_cast<std::size_t>(i)] && std::abs(step[i]) > kSignificant * sigma[i];
  };
  double farthest = 0.0;
  for (Index i = 0; i < 6; ++i) {
    if (is_significant(i)) farthest = of_base(step.head<6>());
  }
  for (Index i = 6; i < step.size(); ++i) {
    if (is_significant(i)) farthest = std::max(farthest, std::abs(step[i]) * levers_[i]);
  }
  return farthest;
}

double SurfaceMoves::of_base(const Twist& twist) const {
  const Twist moves = twist.cwiseProduct(levers_.head<6>());
  return moves.head<3>().norm() + moves.tail<3>().norm();
}

}  // namespace lockbox
