// SPDX-License-Identifier: BSD-3-Clause
// The ROS camera calibration format (camera_info.yaml).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lockbox/core/pinhole_camera.hpp"

namespace lockbox {

/// What a camera calibration file says.
struct CameraCalibration {
  PinholeCamera camera;  ///< the ideal pinhole, without the distortion
  /// Coefficients of `plumb_bob` (k1 k2 p1 p2 k3) or `rational_polynomial` (k1 k2 p1 p2 k3 k4 k5
  /// k6); all zero, or empty, means none. Or those of `equidistant` (k1 k2 k3 k4), see below.
  std::vector<double> distortion;
  std::optional<double> depth_scale;  ///< units per metre, an addition of the depth folders
  /// A ray at the angle a from the optical axis is seen at a (1 + k1 a^2 + k2 a^4 + k3 a^6 +
  /// k4 a^8) focal lengths from the principal point: straight lines bend whatever the coefficients.
  bool is_equidistant = false;

  /// Returns whether any coefficient is not zero.
  bool has_distortion() const;
};

/// Throws InputError, with the line, for what is missing or makes no sense.
CameraCalibration read_camera_info(const std::filesystem::path& file);

/// Numbers are written so that reading gives the same doubles.
void write_camera_info(const std::filesystem::path& file, const CameraCalibration& calibration);

}  // namespace lockbox
