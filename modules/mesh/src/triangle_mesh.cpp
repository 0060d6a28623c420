// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/mesh/triangle_mesh.hpp"

namespace lockbox {

Eigen::Vector3d area_vector(const std::array<Eigen::Vector3d, 3>& corners) {
  return 0.5 * (corners[1] - corners[0]).cross(corners[2] - corners[0]);
}

Eigen::AlignedBox3d bounds(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle) {
      box.extend(mesh.vertices[vertex]);
    }
  }
  return box;
}

double surface_area(const TriangleMesh& mesh) {
  double area = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    area += area_vector(mesh.corners(t)).norm();
  }
  return area;
}

double signed_volume(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) {
    return 0.0;
  }
  // Measured from the middle of the body: far from the origin the tetrahedra would cancel badly.
  const Eigen::Vector3d middle = bounds(mesh).center();
  double volume = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto corners = mesh.corners(t);
    volume += (corners[0] - middle).dot(area_vector(corners)) / 3.0;
  }
  return volume;
}

TriangleMesh transformed(TriangleMesh mesh, const Eigen::Isometry3d& T_a_b) {
  for (Eigen::Vector3d& vertex : mesh.vertices) {
    vertex = T_a_b * vertex;
  }
  return mesh;
}

void append(TriangleMesh& mesh, const TriangleMesh& other) {
  const auto offset = static_cast<std::uint32_t>(mesh.vertices.size());
  const std::size_t vertices = other.vertices.size();
  const std::size_t triangles = other.triangles.size();
  // By number, not by iterator: a mesh may be appended to itself.
  mesh.vertices.reserve(offset + vertices);
  for (std::size_t v = 0; v < vertices; ++v) {
    mesh.vertices.emplace_back(other.vertices[v]);
  }
  mesh.triangles.reserve(mesh.triangles.size() + triangles);
  for (std::size_t t = 0; t < triangles; ++t) {
    const auto [a, b, c] = other.triangles[t];
    mesh.triangles.push_back({a + offset, b + offset, c + offset});
  }
}

}  // namespace lockbox
