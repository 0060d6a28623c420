// SPDX-License-Identifier: BSD-3-Clause
// A point cloud as it comes from PCL, and how the registration sees it.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "lockbox/cloud/tiled_cloud.hpp"

namespace lockbox {

struct Scan {
  std::vector<Eigen::Vector3f> points;  ///< cloud frame, metres; not finite: not measured
  int width = 0;
  int height = 0;
  Eigen::Isometry3d T_cloud_sensor = Eigen::Isometry3d::Identity();  ///< as the cloud states it
  std::vector<std::uint8_t> used;  ///< by point; empty: all. Others only say what is seen through.
};

/// Tiles the scan as an image if its points lie on the rays of the camera (if none is given: of the
/// one that explains them best) and returns the pose of the cloud's frame in the camera's. The
/// camera stands where the scan says, or in the frame's origin: files often turn the stated sensor
/// for display only, so the points decide. Nothing if the scan is no image.
std::optional<Eigen::Isometry3d> tile_image(const Scan& scan,
                                            const std::optional<PinholeCamera>& camera,
                                            const Executor& executor, TiledCloud& cloud);

/// Tiles the scan as mere points, seen from the scan's sensor looking at center (cloud frame, the
/// middle of the object), and returns the pose of the cloud's frame in that view.
Eigen::Isometry3d tile_points(const Scan& scan, const std::optional<PinholeCamera>& camera,
                              const Eigen::Vector3d& center, TiledCloud& cloud);

}  // namespace lockbox
