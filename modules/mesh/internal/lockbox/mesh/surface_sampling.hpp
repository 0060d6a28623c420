// SPDX-License-Identifier: BSD-3-Clause
// Points that stand for a surface, whatever its tessellation.
#pragma once

#include "lockbox/mesh/triangle_mesh.hpp"

namespace lockbox {

struct SurfaceSample {
  Eigen::Vector3d position;  ///< metres
  Eigen::Vector3d normal;    ///< unit, of the triangle
  double area;               ///< m^2 that the sample stands for, the same for all samples
};

/// About area / spacing^2 points (at least one), spread evenly by area. The triangles are walked
/// along a space-filling curve and sampled at equal steps of area, with low-discrepancy positions
/// within each, so that the result follows from the geometry alone: neither the order of the
/// triangles nor their size matters to the density. Samples that follow each other are neighbours.
/// spacing: metres, positive. Throws InputError where that makes more than ten million points.
std::vector<SurfaceSample> sample_surface(const TriangleMesh& mesh, double spacing);

}  // namespace lockbox
