// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <unordered_map>

#include "lockbox/mesh/repair.hpp"
#include "lockbox/mesh/topology.hpp"

namespace lockbox {
namespace {

using Cell = std::array<std::int64_t, 3>;

struct CellHash {
  std::size_t operator()(const Cell& cell) const {
    std::uint64_t hash = 0;
    for (const std::int64_t coordinate : cell) {
      hash = (hash ^ static_cast<std::uint64_t>(coordinate)) * 0x9E3779B97F4A7C15ULL;
      hash ^= hash >> 29;
    }
    return static_cast<std::size_t>(hash);
  }
};

/// Finds earlier vertices within a radius. Cells are as wide as the ball, which so meets at most
/// eight of them.
class VertexIndex {
 public:
  VertexIndex(double radius, const Eigen::Vector3d& origin) : radius_(radius), origin_(origin) {}

  /// The first vertex closer than the radius to vertices[i], or i itself, which is then stored.
  std::uint32_t find_or_insert(const std::vector<Eigen::Vector3d>& vertices, std::uint32_t i) {
    const Eigen::Vector3d& p = vertices[i];
    const Cell low = cell_of(p.array() - radius_);
    const Cell high = cell_of(p.array() + radius_);
    std::uint32_t found = i;
    for (std::int64_t z = low[2]; z <= high[2]; ++z) {
      for (std::int64_t y = low[1]; y <= high[1]; ++y) {
        for (std::int64_t x = low[0]; x <= high[0]; ++x) {
          const auto [begin, end] = cells_.equal_range({x, y, z});
          for (auto entry = begin; entry != end; ++entry) {
            if ((vertices[entry->second] - p).squaredNorm() <= radius_ * radius_) {
              found = std::min(found, entry->second);
            }
          }
        }
      }
    }
    if (found == i) {
      cells_.emplace(cell_of(p.array()), i);
    }
    return found;
  }

 private:
  Cell cell_of(const Eigen::Array3d& p) const {
    const Eigen::Array3d scaled = ((p - origin_.array()) / (2.0 * radius_)).floor();
    return {static_cast<std::int64_t>(scaled.x()), static_cast<std::int64_t>(scaled.y()),
            static_cast<std::int64_t>(scaled.z())};
  }

  double radius_;
  Eigen::Vector3d origin_;
  std::unordered_multimap<Cell, std::uint32_t, CellHash> cells_;
};

/// Returns what is the same for the same corners in the same sense of rotation.
std::array<std::uint32_t, 3> smallest_first(std::array<std::uint32_t, 3> triangle) {
  std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
  return triangle;
}

/// Returns, of triangles that repeat others, those without which edges would have an odd number of
/// faces: two solids that overlap with a face in common need both, a face that a file holds twice
/// does not.
std::vector<std::array<std::uint32_t, 3>> needed_twice(
    const TriangleMesh& mesh, const std::vector<std::array<std::uint32_t, 3>>& repeated) {
  if (repeated.empty()) return {};
  TriangleMesh all{mesh.vertices, repeated};
  const Shells patches = find_shells(all);
  all.triangles.insert(all.triangles.end(), mesh.triangles.begin(), mesh.triangles.end());
  std::vector<std::uint8_t> is_needed(patches.count, 0);
  std::vector<std::uint8_t> is_surplus(patches.count, 0);
  for_each_edge(sorted_half_edges(all), [&](std::span<const HalfEdge> edge) {
    for (const HalfEdge& half : edge) {
      if (half.triangle >= repeated.size()) continue;
      const std::uint32_t patch = patches.of_triangle[half.triangle];
      const auto others = std::count_if(edge.begin(), edge.end(), [&](const HalfEdge& other) {
        return other.triangle >= repeated.size() || patches.of_triangle[other.triangle] != patch;
      });
      if (others % 2 != 0) is_needed[patch] = 1;
      if (others % 2 == 0 && edge.size() % 2 != 0) is_surplus[patch] = 1;
    }
  });
  std::vector<std::array<std::uint32_t, 3>> needed;
  for (std::size_t t = 0; t < repeated.size(); ++t) {
    const std::uint32_t patch = patches.of_triangle[t];
    if (is_needed[patch] != 0 && is_surplus[patch] == 0) needed.push_back(repeated[t]);
  }
  return needed;
}

}  // namespace

TriangleMesh welded(const TriangleMesh& mesh, double tolerance) {
  const Eigen::AlignedBox3d box = bounds(mesh);
  if (box.isEmpty()) {
    return {};
  }
  const double radius = std::max(tolerance > 0.0 ? tolerance : 1e-6 * box.diagonal().norm(),
                                 std::numeric_limits<double>::min());
  VertexIndex index(radius, box.min());
  constexpr std::uint32_t kUnseen = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> merged(mesh.vertices.size(), kUnseen);
  std::vector<std::uint32_t> renumbered(mesh.vertices.size(), kUnseen);
  std::set<std::array<std::uint32_t, 3>> seen;
  std::vector<std::array<std::uint32_t, 3>> repeated;
  TriangleMesh result;
  for (auto triangle : mesh.triangles) {
    for (std::uint32_t& vertex : triangle) {
      if (merged[vertex] == kUnseen) {
        merged[vertex] = index.find_or_insert(mesh.vertices, vertex);
      }
      vertex = merged[vertex];
    }
    const auto& [a, b, c] = triangle;
    const Eigen::Vector3d doubled_area =
        (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
    if (a == b || b == c || c == a || doubled_area.isZero(0.0)) {
      continue;
    }
    for (std::uint32_t& vertex : triangle) {
      if (renumbered[vertex] == kUnseen) {
        renumbered[vertex] = static_cast<std::uint32_t>(result.vertices.size());
        result.vertices.push_back(mesh.vertices[vertex]);
      }
      vertex = renumbered[vertex];
    }
    const bool is_new = seen.insert(smallest_first(triangle)).second;
    (is_new ? result.triangles : repeated).push_back(triangle);
  }
  const auto needed = needed_twice(result, repeated);
  result.triangles.insert(result.triangles.end(), needed.begin(), needed.end());
  return result;
}

}  // namespace lockbox
