// SPDX-License-Identifier: BSD-3-Clause
// How triangles hang together along their edges. Meaningful after welding.
#pragma once

#include <algorithm>
#include <span>
#include <tuple>

#include "lockbox/mesh/triangle_mesh.hpp"

namespace lockbox {

/// One side of one triangle. Two consistent neighbours run through their edge in opposite
/// directions.
struct HalfEdge {
  std::uint32_t low;   ///< the smaller vertex
  std::uint32_t high;  ///< the larger vertex
  std::uint32_t triangle;
  bool forward;  ///< the triangle runs from low to high
};

/// All 3 n half-edges, those of one edge in a row, by triangle. O(n log n).
std::vector<HalfEdge> sorted_half_edges(const TriangleMesh& mesh);

/// Calls visit(span) once for each edge with all its half-edges: one at an open edge, two at a
/// manifold one.
template <typename Visitor>
void for_each_edge(std::span<const HalfEdge> sorted, Visitor&& visit) {
  for (std::size_t begin = 0; begin < sorted.size();) {
    std::size_t end = begin + 1;
    while (end < sorted.size() && sorted[end].low == sorted[begin].low &&
           sorted[end].high == sorted[begin].high) {
      ++end;
    }
    visit(sorted.subspan(begin, end - begin));
    begin = end;
  }
}

/// Which shell each triangle belongs to: triangles joined by manifold edges share one. Shells are
/// numbered from 0 by their first triangle.
struct Shells {
  std::vector<std::uint32_t> of_triangle;
  std::uint32_t count = 0;
};
Shells find_shells(const TriangleMesh& mesh);

/// 1 for each triangle with a side that is not used equally often in both directions. Without any,
/// the surface is closed: its winding number is an integer everywhere.
std::vector<std::uint8_t> triangles_at_open_edges(const TriangleMesh& mesh);

}  // namespace lockbox
