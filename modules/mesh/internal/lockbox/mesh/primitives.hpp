// SPDX-License-Identifier: BSD-3-Clause
// Closed meshes of the primitive shapes that URDF has, with its conventions: centred on the origin.
#pragma once

#include "lockbox/mesh/triangle_mesh.hpp"

namespace lockbox {

/// Edge lengths in metres. Throws InputError unless all are positive and finite.
TriangleMesh make_box(const Eigen::Vector3d& size);

/// Metres; the axis is z. The vertices lie on the cylinder, the flat sides at most 0.05 mm inside
/// it for radii up to 0.3 m (256 sides at most). Throws InputError unless both are positive.
TriangleMesh make_cylinder(double radius, double length);

/// Metres. The vertices lie on the sphere, the faces at most 0.1 mm inside it for radii up to
/// 0.4 m (32768 triangles at most). Throws InputError unless the radius is positive.
TriangleMesh make_sphere(double radius);

}  // namespace lockbox
