// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/model/motion_scales.hpp"

#include <algorithm>
#include <vector>

#include "lockbox/model/forward_kinematics.hpp"

namespace lockbox {

Eigen::VectorXd motion_scales(const KinematicTree& tree) {
  Configuration rest = rest_configuration(tree);
  rest.T_camera_base.setIdentity();
  std::vector<Eigen::Isometry3d> poses;
  std::vector<BodyJacobian> jacobians;
  forward_kinematics(tree, rest, poses);
  body_jacobians(tree, poses, jacobians);
  Eigen::VectorXd scales = Eigen::VectorXd::Zero(tree.unknowns());
  for (std::size_t b = 0; b < tree.bodies.size(); ++b) {
    const Eigen::AlignedBox3d box = bounds(tree.bodies[b].mesh);
    for (int corner = 0; corner < 8 && !box.isEmpty(); ++corner) {
      const Eigen::Vector3d p = box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner));
      for (Eigen::Index i = 0; i < scales.size(); ++i) {
        const Twist twist = jacobians[b].col(i);
        const Eigen::Vector3d motion = twist.head<3>() + twist.tail<3>().cross(p);
        scales[i] = std::max(scales[i], motion.norm());
      }
    }
  }
  return scales;
}

}  // namespace lockbox
