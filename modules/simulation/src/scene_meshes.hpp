// SPDX-License-Identifier: BSD-3-Clause
// The shapes that scenes are made of, with few triangles.
#pragma once

#include <Eigen/Geometry>

#include "lockbox/mesh/triangle_mesh.hpp"

namespace lockbox::simulation {

/// A rectangle in z = 0 around the origin.
TriangleMesh make_rectangle(const Eigen::Vector2d& extent);

/// All points within radius of the segment from the origin to (0, 0, length); metres.
TriangleMesh make_capsule(double length, double radius);

/// A rotation whose z axis is the direction (of any length but 0) and whose x axis is normal to y,
/// if it can be.
Eigen::Matrix3d rotation_along(const Eigen::Vector3d& direction);

}  // namespace lockbox::simulation
