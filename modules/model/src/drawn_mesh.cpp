// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/model/drawn_mesh.hpp"

#include <algorithm>
#include <cmath>

#include "lockbox/mesh/simplify.hpp"

namespace lockbox {
namespace {

/// Where a small part is missing, they lie within the body.
bool lies_on(const SignedDistanceField& field, double most_off, const TriangleMesh& mesh) {
  const auto is_near = [&](const Eigen::Vector3d& p) {
    return std::abs(static_cast<double>(field.sample(p.cast<float>()).distance)) <= most_off;
  };
  const auto middle_is_near = [&](const auto& triangle) {
    const auto& [a, b, c] = triangle;
    return is_near((mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3.0);
  };
  return std::all_of(mesh.vertices.begin(), mesh.vertices.end(), is_near) &&
         std::all_of(mesh.triangles.begin(), mesh.triangles.end(), middle_is_near);
}

}  // namespace

TriangleMesh drawn_mesh(const TriangleMesh& mesh, const SignedDistanceField& field,
                        std::size_t fewest, double most_off) {
  for (std::size_t few = fewest; 2 * few <= mesh.triangles.size(); few *= 2) {
    TriangleMesh simple = simplified(mesh, few);
    if (lies_on(field, most_off, simple)) return simple;
  }
  return mesh;
}

}  // namespace lockbox
