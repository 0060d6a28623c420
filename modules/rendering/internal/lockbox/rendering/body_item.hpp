// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lockbox/model/kinematic_tree.hpp"
#include "lockbox/rendering/depth_renderer.hpp"

namespace lockbox {

/// A body of the model to draw; its pixels are marked with its index. It refers to the tree.
inline RenderItem body_item(const KinematicTree& tree, std::size_t body,
                            const Eigen::Isometry3d& T_camera_body) {
  const Body& drawn = tree.bodies[body];
  return {&drawn.mesh, T_camera_body, static_cast<std::int16_t>(body), drawn.encloses_solid};
}

}  // namespace lockbox
