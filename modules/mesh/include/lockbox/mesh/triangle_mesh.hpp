// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace lockbox {

/// Triangles over shared vertices, metres. Outward faces are counter-clockwise.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices;                ///< positions, metres
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices of the three corners

  /// Returns the three corners of triangle t.
  std::array<Eigen::Vector3d, 3> corners(std::size_t t) const {
    return {vertices[triangles[t][0]], vertices[triangles[t][1]], vertices[triangles[t][2]]};
  }
};

/// Returns half the cross product of two edges, which is the outward normal times the area, m^2.
Eigen::Vector3d area_vector(const std::array<Eigen::Vector3d, 3>& corners);

/// Returns the box around all vertices that a triangle uses, metres; it is empty for a mesh without
/// triangles.
Eigen::AlignedBox3d bounds(const TriangleMesh& mesh);

/// Returns the sum of the areas of all triangles, m^2.
double surface_area(const TriangleMesh& mesh);

/// Returns the volume by the divergence theorem, m^3. It is negative when the faces point inwards,
/// and shells that overlap count twice where they do. For a surface that is not closed it means
/// nothing.
double signed_volume(const TriangleMesh& mesh);

/// Returns the mesh with each vertex p replaced by T_a_b p.
TriangleMesh transformed(TriangleMesh mesh, const Eigen::Isometry3d& T_a_b);

/// Adds the triangles of other; nothing is welded.
void append(TriangleMesh& mesh, const TriangleMesh& other);

}  // namespace lockbox
