// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_parts.hpp"

#include <utility>

#include "lockbox/mesh/topology.hpp"

namespace lockbox {

MeshParts::MeshParts(const TriangleMesh& mesh) {
  Shells shells = find_shells(mesh);
  std::vector<std::uint8_t> is_open(shells.count, 0);
  for_each_edge(sorted_half_edges(mesh), [&](std::span<const HalfEdge> edge) {
    if (edge.size() != 2) {
      for (const HalfEdge& half : edge) {
        is_open[shells.of_triangle[half.triangle]] = 1;
      }
    }
  });
  of_triangle = std::move(shells.of_triangle);
  boxes.resize(shells.count + 1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::uint32_t& part = of_triangle[t];
    part = is_open[part] != 0 ? shells.count : part;
    for (const Eigen::Vector3d& corner : mesh.corners(t)) {
      boxes[part].extend(corner);
    }
  }
}

}  // namespace lockbox
