// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/model/model_bounds.hpp"

#include <vector>

#include "lockbox/model/forward_kinematics.hpp"

namespace lockbox {

Eigen::AlignedBox3d model_bounds(const KinematicTree& tree, const Configuration& configuration) {
  std::vector<Eigen::Isometry3d> T_base_body;
  forward_kinematics(tree, {Eigen::Isometry3d::Identity(), configuration.q}, T_base_body);
  Eigen::AlignedBox3d box;
  for (std::size_t b = 0; b < tree.bodies.size(); ++b) {
    for (const auto& vertex : tree.bodies[b].mesh.vertices) {
      box.extend(T_base_body[b] * vertex);
    }
  }
  return box;
}

}  // namespace lockbox
