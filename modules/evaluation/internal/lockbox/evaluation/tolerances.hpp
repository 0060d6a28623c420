// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lockbox/model/kinematic_tree.hpp"

namespace lockbox {

/// Errors up to which an estimate counts as right.
struct Tolerances {
  double translation = 0.02;      ///< of the base, metres
  double rotation = 0.034906585;  ///< of the base, radians: 2 degrees
  double sliding = 0.01;          ///< of a prismatic joint, metres
  double turning = 0.087266463;   ///< of a revolute or continuous joint, radians: 5 degrees

  double joint(JointType type) const { return type == JointType::prismatic ? sliding : turning; }
};

/// A frame determines an unknown if its bound lies below this share of the tolerance.
inline constexpr double kDeterminedShare = 0.2;

/// What a frame determines of a configuration.
struct Determined {
  bool translation = true;
  bool rotation = true;
  std::vector<bool> joints;  ///< by joint of the tree
};

/// sigma: standard deviations of base twist (v, w) and joint variables, as in FrameBound.
Determined determined_unknowns(const KinematicTree& tree, const Eigen::VectorXd& sigma,
                               const Tolerances& tolerances = {});

/// Everything: for evaluations without bounds.
Determined all_unknowns(const KinematicTree& tree);

}  // namespace lockbox
