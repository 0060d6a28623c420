// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <numeric>
#include <utility>

#include "lockbox/mesh/repair.hpp"
#include "lockbox/mesh/topology.hpp"

namespace lockbox {
namespace {

std::array<std::uint32_t, 3> sorted(std::array<std::uint32_t, 3> triangle) {
  std::sort(triangle.begin(), triangle.end());
  return triangle;
}

/// Triangles that have the same corners as another, pair by pair, and all others.
struct Sides {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  std::vector<std::uint32_t> single;
};

Sides find_sides(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> order(mesh.triangles.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(sorted(mesh.triangles[a]), a) < std::pair(sorted(mesh.triangles[b]), b);
  });
  Sides sides;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool is_pair = i + 1 < order.size() &&
                         sorted(mesh.triangles[order[i]]) == sorted(mesh.triangles[order[i + 1]]);
    if (is_pair) {
      sides.pairs.emplace_back(order[i], order[i + 1]);
      ++i;
    } else {
      sides.single.push_back(order[i]);
    }
  }
  return sides;
}

/// Returns for each pair whether it lies where two solids touch, or is a sheet without thickness:
/// where its patch ends, single triangles go on without it, two by two.
std::vector<std::uint8_t> find_contacts(const TriangleMesh& mesh, const Sides& sides) {
  TriangleMesh patches{mesh.vertices, {}};
  for (const auto& [one, other] : sides.pairs) patches.triangles.push_back(mesh.triangles[one]);
  const Shells shells = find_shells(patches);
  for (const std::uint32_t t : sides.single) patches.triangles.push_back(mesh.triangles[t]);
  std::vector<std::uint8_t> goes_on_without(shells.count, 0);
  std::vector<std::uint8_t> is_needed(shells.count, 0);
  for_each_edge(sorted_half_edges(patches), [&](std::span<const HalfEdge> edge) {
    const auto singles = std::count_if(edge.begin(), edge.end(), [&](const HalfEdge& half) {
      return half.triangle >= sides.pairs.size();
    });
    for (const HalfEdge& half : edge) {
      if (half.triangle >= sides.pairs.size() || singles == 0) continue;
      const std::uint32_t shell = shells.of_triangle[half.triangle];
      (singles % 2 == 0 ? goes_on_without : is_needed)[shell] = 1;
    }
  });
  std::vector<std::uint8_t> contacts;
  for (std::size_t pair = 0; pair < sides.pairs.size(); ++pair) {
    const std::uint32_t shell = shells.of_triangle[pair];
    contacts.push_back(goes_on_without[shell] != 0 && is_needed[shell] == 0 ? 1 : 0);
  }
  return contacts;
}

}  // namespace

TriangleMesh one_sided(const TriangleMesh& mesh) {
  const Sides sides = find_sides(mesh);
  if (sides.pairs.empty()) return mesh;
  const std::vector<std::uint8_t> contacts = find_contacts(mesh, sides);
  std::vector<std::uint8_t> is_dropped(mesh.triangles.size(), 0);
  for (std::size_t pair = 0; pair < sides.pairs.size(); ++pair) {
    if (contacts[pair] == 0) is_dropped[sides.pairs[pair].second] = 1;
  }
  TriangleMesh result{mesh.vertices, {}};
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (is_dropped[t] == 0) result.triangles.push_back(mesh.triangles[t]);
  }
  // Which of both sides came first says nothing.
  return result.triangles.size() == mesh.triangles.size() ? mesh
                                                          : oriented_outwards(std::move(result));
}

}  // namespace lockbox
