// SPDX-License-Identifier: BSD-3-Clause
// How often a surface winds around a point: 1 inside a closed surface, 0 outside, and in between
// where the surface is open.
#pragma once

#include "lockbox/mesh/triangle_mesh.hpp"

namespace lockbox {

/// Signed solid angle of a triangle seen from the origin, steradians, positive when the origin is
/// behind it (Van Oosterom and Strackee, "The solid angle of a plane triangle", 1983).
double solid_angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

/// Generalised winding number of the mesh at p (Jacobson et al. 2013): the sum over all triangles.
double winding_number(const TriangleMesh& mesh, const Eigen::Vector3d& p);

}  // namespace lockbox
