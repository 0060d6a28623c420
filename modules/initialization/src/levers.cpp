// SPDX-License-Identifier: BSD-3-Clause
#include "levers.hpp"

#include <algorithm>

#include "lockbox/model/forward_kinematics.hpp"

namespace lockbox {

ModelLevers model_levers(const KinematicTree& tree) {
  Configuration rest = rest_configuration(tree);
  rest.T_camera_base.setIdentity();
  std::vector<Eigen::Isometry3d> poses;
  std::vector<BodyJacobian> jacobians;
  forward_kinematics(tree, rest, poses);
  body_jacobians(tree, poses, jacobians);
  ModelLevers levers{Eigen::Vector3d::Zero(), 0.0, Eigen::VectorXd::Zero(tree.variables())};
  Eigen::AlignedBox3d whole;
  for (std::size_t b = 0; b < poses.size(); ++b) {
    const Eigen::AlignedBox3d box = bounds(tree.bodies[b].mesh);
    for (int corner = 0; corner < 8 && !box.isEmpty(); ++corner) {
      const Eigen::Vector3d p = box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner));
      whole.extend(poses[b] * p);
      for (int v = 0; v < tree.variables(); ++v) {
        const Twist twist = jacobians[b].col(6 + v);
        const Eigen::Vector3d motion = twist.head<3>() + twist.tail<3>().cross(p);
        levers.variables[v] = std::max(levers.variables[v], motion.norm());
      }
    }
  }
  levers.centre = whole.isEmpty() ? Eigen::Vector3d::Zero() : Eigen::Vector3d(whole.center());
  levers.radius = whole.isEmpty() ? 1.0 : 0.5 * whole.diagonal().norm();
  return levers;
}

}  // namespace lockbox
