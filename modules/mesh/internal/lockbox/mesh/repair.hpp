// SPDX-License-Identifier: BSD-3-Clause
// Defects of CAD exports that have one sensible reading.
#pragma once

#include "lockbox/mesh/triangle_mesh.hpp"

namespace lockbox {

/// Merges vertices closer than tolerance (metres; default a millionth of the bounds' diagonal) into
/// the first of them, drops the triangles that lose their area, those that repeat another without
/// need (two solids with a face in common need it twice), and the vertices that nobody uses.
TriangleMesh welded(const TriangleMesh& mesh, double tolerance = 0.0);

/// Drops the second of triangles that are there twice, once for each side, as exporters write
/// materials seen from both sides, and turns the rest outwards (see oriented_outwards()). Two
/// solids that touch keep both, since neither is closed without. For a mesh that is welded().
TriangleMesh one_sided(const TriangleMesh& mesh);

/// Turns triangles until neighbours agree, shell by shell, keeping as much of the area as possible
/// as it was; then turns each closed shell that is inside-out. Shells nested in a turned one turn
/// with it, so a cavity stays a cavity and a solid within a solid stays solid. Of a body whose
/// open patches make up a closed surface together, the patches are turned together.
TriangleMesh oriented_outwards(TriangleMesh mesh);

/// Closes holes that are small, at most a hundredth of the area of the shell that they are in and a
/// fifth of its diagonal, and whose border meets no other: by a fan around the border's middle.
/// Shells with more than a twentieth of their area in such holes are left as they are. For a mesh
/// that is welded() and oriented_outwards().
TriangleMesh with_small_holes_closed(const TriangleMesh& mesh);

}  // namespace lockbox
