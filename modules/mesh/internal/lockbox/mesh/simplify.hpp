// SPDX-License-Identifier: BSD-3-Clause
// Meshes for drawings in which most triangles of the full ones would be smaller than a pixel.
#pragma once

#include <cstddef>

#include "lockbox/mesh/triangle_mesh.hpp"

namespace lockbox {

/// Nearly the same surface by about so many triangles: edges are collapsed, those first where that
/// changes least (Garland and Heckbert, Surface Simplification Using Quadric Error Metrics, 1997).
/// What has no more triangles is returned as it is.
TriangleMesh simplified(const TriangleMesh& mesh, std::size_t most_triangles);

}  // namespace lockbox
