// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/mesh/content_hash.hpp"

namespace lockbox {

std::uint64_t content_hash(const TriangleMesh& mesh) {
  ContentHash hash;
  hash.add(std::uint64_t{mesh.vertices.size()});
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    for (const double coordinate : vertex) {
      hash.add(coordinate);
    }
  }
  hash.add(std::as_bytes(std::span(mesh.triangles)));
  return hash.value();
}

}  // namespace lockbox
