// SPDX-License-Identifier: BSD-3-Clause
// The ideal pinhole of a depth camera, in its optical frame (x right, y down, z forward, metres).
#pragma once

#include <Eigen/Core>

namespace lockbox {

/// Pixel centres lie at integer coordinates: the image spans [-0.5, width - 0.5].
struct PinholeCamera {
  int width = 0;    ///< pixels
  int height = 0;   ///< pixels
  double fx = 0.0;  ///< focal lengths, pixels
  double fy = 0.0;
  double cx = 0.0;  ///< principal point, pixels
  double cy = 0.0;

  /// The point at depth z (metres along the optical axis) seen by pixel (u, v).
  Eigen::Vector3d back_project(double u, double v, double z) const {
    return {(u - cx) / fx * z, (v - cy) / fy * z, z};
  }

  /// The pixel (u, v) that sees p_camera; p_camera.z() must be positive.
  Eigen::Vector2d project(const Eigen::Vector3d& p_camera) const {
    return {fx * p_camera.x() / p_camera.z() + cx, fy * p_camera.y() / p_camera.z() + cy};
  }

  bool operator==(const PinholeCamera&) const = default;
};

}  // namespace lockbox
