// SPDX-License-Identifier: BSD-3-Clause
// Scenes as the renderer shows them.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "lockbox/rendering/depth_renderer.hpp"

namespace lockbox::testing {

/// rotation: axis times angle, radians.
inline Eigen::Isometry3d placed(const Eigen::Vector3d& position,
                                const Eigen::Vector3d& rotation = Eigen::Vector3d::Zero()) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() = position;
  if (rotation.norm() > 0.0) {
    T.linear() = Eigen::AngleAxisd(rotation.norm(), rotation.normalized()).toRotationMatrix();
  }
  return T;
}

inline RenderedDepth rendered(const PinholeCamera& camera, const std::vector<RenderItem>& items,
                              int threads = 2) {
  DepthRenderer renderer(camera, Executor(threads));
  RenderedDepth image;
  renderer.render(items, image);
  return image;
}

inline std::size_t pixel(const PinholeCamera& camera, int u, int v) {
  return static_cast<std::size_t>(v * camera.width + u);
}

}  // namespace lockbox::testing
