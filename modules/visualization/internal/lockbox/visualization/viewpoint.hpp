// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include "lockbox/core/pinhole_camera.hpp"
#include "lockbox/model/configuration.hpp"

namespace lockbox {

struct Viewpoint {
  PinholeCamera camera;
  Eigen::Isometry3d T_camera_base;
};

/// A camera of the given size (pixels) that sees the whole model: in front of the base (its z axis
/// towards the camera, its x axis to the right), somewhat from above and from the side.
Viewpoint overview(const KinematicTree& tree, const Configuration& configuration, int width,
                   int height);

}  // namespace lockbox
