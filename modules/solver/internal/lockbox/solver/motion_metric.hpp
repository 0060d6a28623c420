// SPDX-License-Identifier: BSD-3-Clause
// How far steps move the model's surfaces: a unit for all unknowns that means the same to each.
#pragma once

#include <vector>

#include "lockbox/core/lie.hpp"
#include "lockbox/model/configuration.hpp"
#include "lockbox/model/kinematic_tree.hpp"

namespace lockbox {

class MotionMetric {
 public:
  explicit MotionMetric(const KinematicTree& tree);

  /// How far surfaces lie apart in two near configurations, metres: the most that the base or any
  /// single joint contributes.
  double between(const Configuration& a, const Configuration& b) const;

  /// Returns the distance of a step: base twist (v, w) in the base's frame, then the joint
  /// variables.
  double of(const Eigen::VectorXd& step) const;

  /// Returns the distance for those unknowns that can be seen and that the step moves by several of
  /// their standard deviations. observable, sigma: by unknown.
  double of_significant(const Eigen::VectorXd& step, const std::vector<bool>& observable,
                        const Eigen::VectorXd& sigma) const;

  /// Returns by unknown the metres that surfaces move for a unit, at most.
  const Eigen::VectorXd& scales() const { return scales_; }

 private:
  double of_base(const Twist& twist) const;

  Eigen::VectorXd scales_;
};

}  // namespace lockbox
