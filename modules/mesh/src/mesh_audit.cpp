// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/mesh/mesh_audit.hpp"

#include "lockbox/mesh/repair.hpp"
#include "lockbox/mesh/topology.hpp"

namespace lockbox {

MeshAudit audit(const TriangleMesh& mesh) {
  MeshAudit result;
  for_each_edge(sorted_half_edges(mesh), [&](std::span<const HalfEdge> edge) {
    result.open_edges += edge.size() == 1 ? 1 : 0;
    result.non_manifold_edges += edge.size() > 2 ? 1 : 0;
    result.inconsistent_edges += edge.size() == 2 && edge[0].forward == edge[1].forward ? 1 : 0;
  });
  result.shells = find_shells(mesh).count;
  result.area = surface_area(mesh);
  result.volume = signed_volume(mesh);
  result.bounds = bounds(mesh);
  return result;
}

bool encloses_solid(const TriangleMesh& mesh) {
  const MeshAudit found = audit(mesh);
  return !mesh.triangles.empty() && found.is_closed() && found.non_manifold_edges == 0 &&
         oriented_outwards(mesh).triangles == mesh.triangles;
}

}  // namespace lockbox
