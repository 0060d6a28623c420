// SPDX-License-Identifier: BSD-3-Clause
// What of a mesh bounds the solid that it describes.
#pragma once

#include "lockbox/core/parallel.hpp"
#include "triangle_tree.hpp"
#include "winding_tree.hpp"

namespace lockbox {

struct OuterSurface {
  TriangleMesh mesh;                  ///< triangles, or pieces of them, that are not buried
  std::vector<std::uint32_t> source;  ///< triangle that each one is or comes from
  double volume = 0.0;                ///< of the union of all shells, m^3
};

/// Share of the surface that is missing, estimated from how far the winding number beside the
/// surface is from an integer. 0 for a closed mesh.
double open_share(const TriangleMesh& mesh, const WindingTree& winding);

/// Drops what lies within other shells: there the winding number exceeds one half on both sides.
/// A triangle that is only partly buried is cut, down to a 250th of the body's
/// diagonal; what is buried of the last pieces stays.
OuterSurface find_outer_surface(const TriangleMesh& mesh, const WindingTree& winding,
                                const Executor& executor);

}  // namespace lockbox
