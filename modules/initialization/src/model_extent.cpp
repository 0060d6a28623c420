// SPDX-License-Identifier: BSD-3-Clause
#include "model_extent.hpp"

#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/model/motion_scales.hpp"

namespace lockbox {

ModelExtent model_extent(const KinematicTree& tree) {
  Configuration rest = rest_configuration(tree);
  rest.T_camera_base.setIdentity();
  std::vector<Eigen::Isometry3d> poses;
  forward_kinematics(tree, rest, poses);
  Eigen::AlignedBox3d whole;
  for (std::size_t b = 0; b < poses.size(); ++b) {
    const Eigen::AlignedBox3d box = bounds(tree.bodies[b].mesh);
    if (!box.isEmpty()) whole.extend(box.transformed(poses[b]));
  }
  return {whole.isEmpty() ? Eigen::Vector3d::Zero() : Eigen::Vector3d(whole.center()),
          whole.isEmpty() ? Eigen::Vector3d::Zero() : Eigen::Vector3d(whole.sizes()),
          whole.isEmpty() ? 1.0 : 0.5 * whole.diagonal().norm(),
          motion_scales(tree).tail(tree.variables())};
}

}  // namespace lockbox
