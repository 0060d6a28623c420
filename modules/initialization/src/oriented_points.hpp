// SPDX-License-Identifier: BSD-3-Clause
// Points of what a camera sees, each with the normal of the surface there: of a scene, and of a
// model that is looked at from all sides in the same way.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

#include "lockbox/core/parallel.hpp"
#include "lockbox/core/pinhole_camera.hpp"
#include "lockbox/model/kinematic_tree.hpp"

namespace lockbox {

struct OrientedPoint {
  Eigen::Vector3f position;  ///< metres
  Eigen::Vector3f normal;    ///< unit, out of the surface
};

/// A depth image, row by row, metres; 0 where nothing is known or what is there is of no concern.
struct DepthView {
  PinholeCamera camera;
  std::span<const float> depth;
  double noise = 0.0;  ///< standard deviation of 1/depth of a sample, 1/metre
};

/// Points about `spacing` metres apart across the camera's rays. Each lies in the plane that fits
/// what is around it within that distance.
std::vector<OrientedPoint> points_of_view(const DepthView& view, double spacing);

/// Points of one body, about `spacing` metres apart, of what can be seen of it when it is alone; in
/// its frame.
std::vector<OrientedPoint> points_of_body(const KinematicTree& tree, std::size_t body,
                                          double spacing, const Executor& executor);

}  // namespace lockbox
