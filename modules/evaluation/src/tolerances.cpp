// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/tolerances.hpp"

#include <cmath>

namespace lockbox {

Determined determined_unknowns(const KinematicTree& tree, const Eigen::VectorXd& sigma,
                               const Tolerances& tolerances) {
  Determined determined;
  determined.translation = sigma.head<3>().norm() < kDeterminedShare * tolerances.translation;
  determined.rotation = sigma.segment<3>(3).norm() < kDeterminedShare * tolerances.rotation;
  for (const Joint& joint : tree.joints) {
    const double joint_sigma = std::abs(joint.multiplier) * sigma[unknown_of(joint.variable)];
    determined.joints.push_back(joint_sigma < kDeterminedShare * tolerances.joint(joint.type));
  }
  return determined;
}

Determined all_unknowns(const KinematicTree& tree) {
  return {true, true, std::vector<bool>(tree.joints.size(), true)};
}

}  // namespace lockbox
