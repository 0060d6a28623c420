// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/mesh/content_hash.hpp"

#include <array>
#include <cinttypes>
#include <cstdio>

namespace lockbox {

std::string hash_text(std::uint64_t hash) {
  std::array<char, 17> digits{};
  std::snprintf(digits.data(), digits.size(), "%016" PRIx64, hash);
  return digits.data();
}

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
