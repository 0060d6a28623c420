// SPDX-License-Identifier: BSD-3-Clause
// The ideal pinhole of a depth camera, in its optical frame (x right, y down, z forward, metres).
#pragma once

#include <Eigen/Core>
#include <optional>

namespace lockbox {

/// A pixel of an image, counted from the left upper one.
struct Pixel {
  int u = 0;  ///< column
  int v = 0;  ///< row
};

/// Pixel centres lie at integer coordinates: the image spans [-0.5, width - 0.5].
struct PinholeCamera {
  int width = 0;    ///< pixels
  int height = 0;   ///< pixels
  double fx = 0.0;  ///< focal lengths, pixels
  double fy = 0.0;  ///< the same along v
  double cx = 0.0;  ///< principal point, pixels
  double cy = 0.0;  ///< the same along v

  /// Returns the point at depth z (metres along the optical axis) seen by pixel (u, v).
  Eigen::Vector3d back_project(double u, double v, double z) const {
    return {(u - cx) / fx * z, (v - cy) / fy * z, z};
  }

  /// Returns the pixel (u, v) that sees p_camera; p_camera.z() must be positive.
  Eigen::Vector2d project(const Eigen::Vector3d& p_camera) const {
    return {fx * p_camera.x() / p_camera.z() + cx, fy * p_camera.y() / p_camera.z() + cy};
  }

  /// Returns the pixel that p_camera falls into; none outside the image, or behind the camera.
  std::optional<Pixel> pixel_of(const Eigen::Vector3d& p_camera) const {
    if (p_camera.z() <= 0.0) {
      return std::nullopt;
    }
    const Eigen::Vector2d shifted = project(p_camera) + Eigen::Vector2d(0.5, 0.5);
    const bool inside =
        shifted.x() >= 0.0 && shifted.y() >= 0.0 && shifted.x() < width && shifted.y() < height;
    return inside
               ? std::optional(Pixel{static_cast<int>(shifted.x()), static_cast<int>(shifted.y())})
               : std::nullopt;
  }

  bool operator==(const PinholeCamera&) const = default;
};

}  // namespace lockbox
