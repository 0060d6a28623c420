// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lockbox/mesh/triangle_mesh.hpp"

namespace lockbox {

/// What there is to say about a mesh as the boundary of a solid. Edges are those of shared
/// vertices: weld first.
struct MeshAudit {
  std::size_t open_edges = 0;          ///< with one triangle
  std::size_t non_manifold_edges = 0;  ///< with more than two
  std::size_t inconsistent_edges = 0;  ///< with two that disagree about what is outside
  std::size_t shells = 0;              ///< parts that hang together by manifold edges
  double area = 0.0;                   ///< m^2
  double volume = 0.0;                 ///< see signed_volume(), m^3
  Eigen::AlignedBox3d bounds;          ///< metres

  /// Whether the divergence theorem holds: closed and consistent.
  bool is_closed() const { return open_edges == 0 && inconsistent_edges == 0; }
};

MeshAudit audit(const TriangleMesh& mesh);

/// Whether the surface is closed, without edges of more than two triangles, and its faces look
/// outwards (see oriented_outwards()): from outside, nothing is seen from behind.
bool encloses_solid(const TriangleMesh& mesh);

}  // namespace lockbox
