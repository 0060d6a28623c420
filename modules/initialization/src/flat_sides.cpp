// SPDX-License-Identifier: BSD-3-Clause
#include "flat_sides.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "lockbox/mesh/topology.hpp"

namespace lockbox {
namespace {

constexpr double kSameSide = 0.9994;   // cosine of two degrees
constexpr double kSameOffset = 0.004;  // metres
/// Cosine of 25 degrees: of polygons with more than 14 corners, which stand for circles, the sides
/// meet at less. Doubled, the sides of an octagon are none any more.
constexpr double kGoesOn = 0.906;

/// Sides, and which one each triangle is part of.
struct Partition {
  std::vector<FlatSide> sides;
  std::vector<std::size_t> of_triangle;  ///< kNone: it has no area
  static constexpr std::size_t kNone = SIZE_MAX;
};

Partition partition(const TriangleMesh& mesh) {
  Partition result;
  result.of_triangle.assign(mesh.triangles.size(), Partition::kNone);
  std::vector<std::pair<FlatSide, std::size_t>> triangles;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto corners = mesh.corners(t);
    const Eigen::Vector3d area = area_vector(corners);
    if (!(area.norm() > 0.0)) continue;
    const Eigen::Vector3d normal = area.normalized();
    const Eigen::Vector3d centre = (corners[0] + corners[1] + corners[2]) / 3.0;
    triangles.push_back({{normal, normal.dot(centre), area.norm()}, t});
  }
  std::stable_sort(triangles.begin(), triangles.end(),
                   [](const auto& a, const auto& b) { return a.first.area > b.first.area; });
  std::vector<FlatSide>& sides = result.sides;
  for (const auto& [triangle, number] : triangles) {
    const FlatSide& flat = triangle;
    const auto same = std::find_if(sides.begin(), sides.end(), [&](const FlatSide& side) {
      return side.normal.dot(flat.normal) > kSameSide &&
             std::abs(side.offset - flat.offset) < kSameOffset;
    });
    result.of_triangle[number] = static_cast<std::size_t>(same - sides.begin());
    if (same == sides.end()) {
      sides.push_back(flat);
    } else {
      same->area += flat.area;
    }
  }
  return result;
}

/// Returns by side whether more than half of its border goes on smoothly: then it is a piece of
/// something round.
std::vector<bool> are_round(const TriangleMesh& mesh, const Partition& partition) {
  std::vector<double> border(partition.sides.size(), 0.0);
  std::vector<double> smooth(partition.sides.size(), 0.0);
  for_each_edge(sorted_half_edges(mesh), [&](std::span<const HalfEdge> edge) {
    const double length = (mesh.vertices[edge[0].high] - mesh.vertices[edge[0].low]).norm();
    const bool is_manifold = edge.size() == 2;
    const bool goes_on =
        is_manifold &&
        area_vector(mesh.corners(edge[0].triangle))
                .normalized()
                .dot(area_vector(mesh.corners(edge[1].triangle)).normalized()) > kGoesOn;
    for (const HalfEdge& half : edge) {
      const std::size_t side = partition.of_triangle[half.triangle];
      const bool is_within = is_manifold && partition.of_triangle[edge[0].triangle] ==
                                                partition.of_triangle[edge[1].triangle];
      if (side == Partition::kNone || is_within) continue;
      border[side] += length;
      if (goes_on) smooth[side] += length;
    }
  });
  std::vector<bool> round(partition.sides.size());
  for (std::size_t i = 0; i < round.size(); ++i) round[i] = smooth[i] > 0.5 * border[i];
  return round;
}

}  // namespace

std::vector<FlatSide> flat_sides(const TriangleMesh& mesh, double least_area) {
  const Partition all = partition(mesh);
  const std::vector<bool> round = are_round(mesh, all);
  std::vector<FlatSide> sides;
  for (std::size_t i = 0; i < all.sides.size(); ++i) {
    if (all.sides[i].area >= least_area && !round[i]) sides.push_back(all.sides[i]);
  }
  std::stable_sort(sides.begin(), sides.end(),
                   [](const FlatSide& a, const FlatSide& b) { return a.area > b.area; });
  return sides;
}

}  // namespace lockbox
