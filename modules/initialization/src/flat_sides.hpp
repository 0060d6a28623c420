// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "lockbox/mesh/triangle_mesh.hpp"

namespace lockbox {

/// Triangles of one plane: those with this outward normal at this distance from the origin.
struct FlatSide {
  Eigen::Vector3d normal;  ///< unit
  double offset;           ///< normal . p, metres
  double area;             ///< m^2
};

/// The flat sides of at least least_area, the largest first; none that are pieces of something
/// round, as the faces of a cylinder are.
std::vector<FlatSide> flat_sides(const TriangleMesh& mesh, double least_area);

}  // namespace lockbox
