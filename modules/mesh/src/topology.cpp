// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/mesh/topology.hpp"

#include <numeric>

namespace lockbox {
namespace {

/// Disjoint sets; the root of a set is its smallest member.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }

  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) {
      parent_[i] = parent_[parent_[i]];
      i = parent_[i];
    }
    return i;
  }

  void join(std::uint32_t a, std::uint32_t b) {
    const auto [low, high] = std::minmax({root(a), root(b)});
    parent_[high] = low;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace

std::vector<HalfEdge> sorted_half_edges(const TriangleMesh& mesh) {
  std::vector<HalfEdge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t side = 0; side < 3; ++side) {
      const std::uint32_t a = mesh.triangles[t][side];
      const std::uint32_t b = mesh.triangles[t][(side + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), static_cast<std::uint32_t>(t), a < b});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const HalfEdge& a, const HalfEdge& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  return edges;
}

Shells find_shells(const TriangleMesh& mesh) {
  DisjointSets sets(mesh.triangles.size());
  for_each_edge(sorted_half_edges(mesh), [&](std::span<const HalfEdge> edge) {
    if (edge.size() == 2) {
      sets.join(edge[0].triangle, edge[1].triangle);
    }
  });
  Shells shells;
  shells.of_triangle.resize(mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint32_t root = sets.root(t);
    shells.of_triangle[t] = root == t ? shells.count++ : shells.of_triangle[root];
  }
  return shells;
}

std::vector<std::uint8_t> triangles_at_open_edges(const TriangleMesh& mesh) {
  std::vector<std::uint8_t> open(mesh.triangles.size(), 0);
  for_each_edge(sorted_half_edges(mesh), [&](std::span<const HalfEdge> edge) {
    const auto forward =
        std::count_if(edge.begin(), edge.end(), [](const HalfEdge& half) { return half.forward; });
    if (2 * static_cast<std::size_t>(forward) != edge.size()) {
      for (const HalfEdge& half : edge) {
        open[half.triangle] = 1;
      }
    }
  });
  return open;
}

}  // namespace lockbox
