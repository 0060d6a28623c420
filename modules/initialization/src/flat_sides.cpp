// SPDX-License-Identifier: BSD-3-Clause
#include "flat_sides.hpp"

#include <algorithm>
#include <cmath>

namespace lockbox {
namespace {

constexpr double kSameNormal = 0.9994;  // cosine of two degrees
constexpr double kSameOffset = 0.004;   // metres

}  // namespace

std::vector<FlatSide> flat_sides(const TriangleMesh& mesh, double least_area) {
  std::vector<FlatSide> triangles;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto corners = mesh.corners(t);
    const Eigen::Vector3d area = area_vector(corners);
    if (!(area.norm() > 0.0)) continue;
    const Eigen::Vector3d normal = area.normalized();
    const Eigen::Vector3d centre = (corners[0] + corners[1] + corners[2]) / 3.0;
    triangles.push_back({normal, normal.dot(centre), area.norm()});
  }
  std::stable_sort(triangles.begin(), triangles.end(),
                   [](const FlatSide& a, const FlatSide& b) { return a.area > b.area; });
  std::vector<FlatSide> sides;
  for (const FlatSide& triangle : triangles) {
    const auto same = std::find_if(sides.begin(), sides.end(), [&](const FlatSide& side) {
      return side.normal.dot(triangle.normal) > kSameNormal &&
             std::abs(side.offset - triangle.offset) < kSameOffset;
    });
    if (same == sides.end()) {
      sides.push_back(triangle);
    } else {
      same->area += triangle.area;
    }
  }
  sides.erase(std::remove_if(sides.begin(), sides.end(),
                             [&](const FlatSide& side) { return side.area < least_area; }),
              sides.end());
  std::stable_sort(sides.begin(), sides.end(),
                   [](const FlatSide& a, const FlatSide& b) { return a.area > b.area; });
  return sides;
}

}  // namespace lockbox
