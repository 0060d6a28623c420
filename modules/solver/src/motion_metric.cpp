// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/solver/motion_metric.hpp"

#include <algorithm>
#include <cmath>

#include "lockbox/model/motion_scales.hpp"

namespace lockbox {
namespace {

using Index = Eigen::Index;

constexpr double kSignificant = 2.0;  // standard deviations: more than noise mostly moves

}  // namespace

MotionMetric::MotionMetric(const KinematicTree& tree) : scales_(motion_scales(tree)) {}

double MotionMetric::between(const Configuration& a, const Configuration& b) const {
  double farthest = of_base(log_se3(a.T_camera_base.inverse() * b.T_camera_base));
  for (int v = 0; v < static_cast<int>(a.q.size()); ++v) {
    farthest = std::max(farthest, std::abs(b.q[v] - a.q[v]) * scales_[unknown_of(v)]);
  }
  return farthest;
}

double MotionMetric::of(const Eigen::VectorXd& step) const {
  double farthest = of_base(step.head<6>());
  for (Index i = kBaseUnknowns; i < step.size(); ++i) {
    farthest = std::max(farthest, std::abs(step[i]) * scales_[i]);
  }
  return farthest;
}

double MotionMetric::of_significant(const Eigen::VectorXd& step,
                                    const std::vector<bool>& observable,
                                    const Eigen::VectorXd& sigma) const {
  const auto is_significant = [&](Index i) {
    return observable[static_cast<std::size_t>(i)] && std::abs(step[i]) > kSignificant * sigma[i];
  };
  double farthest = 0.0;
  for (Index i = 0; i < kBaseUnknowns; ++i) {
    if (is_significant(i)) farthest = of_base(step.head<6>());
  }
  for (Index i = kBaseUnknowns; i < step.size(); ++i) {
    if (is_significant(i)) farthest = std::max(farthest, std::abs(step[i]) * scales_[i]);
  }
  return farthest;
}

double MotionMetric::of_base(const Twist& twist) const {
  const Twist moves = twist.cwiseProduct(scales_.head<6>());
  return moves.head<3>().norm() + moves.tail<3>().norm();
}

}  // namespace lockbox
