// SPDX-License-Identifier: BSD-3-Clause
#include "swept_shapes.hpp"

#include <cmath>
#include <numbers>

namespace lockbox::evaluation {
namespace {

constexpr int kSides = 32;      // of a ring
constexpr int kEndRings = 5;    // of a round end
constexpr int kMeridian = 15;   // rings of an ellipsoid
constexpr int kArcPoints = 12;  // of an arc

/// The next ring's axes, turned as little as the way bends.
Ring carried(const Ring& ring, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const auto turn = Eigen::Quaterniond::FromTwoVectors(from, to);
  return {ring.centre, turn * ring.x, turn * ring.y};
}

Ring scaled(const Ring& ring, const Eigen::Vector3d& offset, double share) {
  return {ring.centre + offset, share * ring.x, share * ring.y};
}

}  // namespace

TriangleMesh swept(const std::vector<Ring>& rings) {
  TriangleMesh mesh;
  mesh.vertices.push_back(rings.front().centre);
  for (const Ring& ring : rings) {
    for (int side = 0; side < kSides; ++side) {
      const double angle = 2.0 * std::numbers::pi * side / kSides;
      mesh.vertices.emplace_back(ring.centre + std::cos(angle) * ring.x + std::sin(angle) * ring.y);
    }
  }
  mesh.vertices.push_back(rings.back().centre);
  const auto vertex = [](std::size_t ring, int side) {
    return static_cast<std::uint32_t>(1 + ring * kSides + static_cast<std::size_t>(side % kSides));
  };
  const std::size_t last = rings.size() - 1;
  const auto end = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  for (int side = 0; side < kSides; ++side) {
    mesh.triangles.push_back({0, vertex(0, side + 1), vertex(0, side)});
    for (std::size_t ring = 0; ring < last; ++ring) {
      const std::uint32_t a = vertex(ring, side);
      const std::uint32_t b = vertex(ring, side + 1);
      const std::uint32_t c = vertex(ring + 1, side + 1);
      const std::uint32_t d = vertex(ring + 1, side);
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
    mesh.triangles.push_back({end, vertex(last, side), vertex(last, side + 1)});
  }
  return mesh;
}

TriangleMesh revolved(std::span<const Eigen::Vector2d> profile) {
  std::vector<Ring> rings;
  for (const Eigen::Vector2d& point : profile) {
    rings.push_back({point.y() * Eigen::Vector3d::UnitZ(), point.x() * Eigen::Vector3d::UnitX(),
                     point.x() * Eigen::Vector3d::UnitY()});
  }
  return swept(rings);
}

TriangleMesh tube(const std::vector<Eigen::Vector3d>& points, double radius) {
  const auto way = [&](std::size_t i) -> Eigen::Vector3d {
    const std::size_t before = i == 0 ? 0 : i - 1;
    const std::size_t after = std::min(i + 1, points.size() - 1);
    return (points[after] - points[before]).normalized();
  };
  const Eigen::Vector3d side = way(0).unitOrthogonal();
  Ring ring{points.front(), radius * side, radius * way(0).cross(side)};
  std::vector<Ring> rings;
  for (int i = 1; i < kEndRings; ++i) {
    const double angle = 0.5 * std::numbers::pi * i / kEndRings;
    rings.push_back(scaled(ring, -radius * std::cos(angle) * way(0), std::sin(angle)));
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i > 0) ring = carried(ring, way(i - 1), way(i));
    ring.centre = points[i];
    rings.push_back(ring);
  }
  for (int i = kEndRings - 1; i > 0; --i) {
    const double angle = 0.5 * std::numbers::pi * i / kEndRings;
    rings.push_back(
        scaled(ring, radius * std::cos(angle) * way(points.size() - 1), std::sin(angle)));
  }
  return swept(rings);
}

TriangleMesh ellipsoid(const Eigen::Vector3d& centre, const Eigen::Vector3d& radii) {
  std::vector<Ring> rings;
  for (int i = 1; i <= kMeridian; ++i) {
    const double angle = std::numbers::pi * i / (kMeridian + 1);
    const double share = std::sin(angle);
    rings.push_back({centre - std::cos(angle) * radii.z() * Eigen::Vector3d::UnitZ(),
                     share * radii.x() * Eigen::Vector3d::UnitX(),
                     share * radii.y() * Eigen::Vector3d::UnitY()});
  }
  return swept(rings);
}

std::vector<Eigen::Vector3d> arc(const Eigen::Vector3d& centre, const Eigen::Vector3d& from,
                                 const Eigen::Vector3d& axis, double angle) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i <= kArcPoints; ++i) {
    const Eigen::AngleAxisd turn(angle * i / kArcPoints, axis.normalized());
    points.emplace_back(centre + turn * (from - centre));
  }
  return points;
}

}  // namespace lockbox::evaluation
