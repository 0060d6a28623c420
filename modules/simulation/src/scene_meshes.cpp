// SPDX-License-Identifier: BSD-3-Clause
#include "scene_meshes.hpp"

#include <cmath>
#include <numbers>

namespace lockbox::simulation {

TriangleMesh make_rectangle(const Eigen::Vector2d& extent) {
  const double x = 0.5 * extent.x();
  const double y = 0.5 * extent.y();
  return {{{-x, -y, 0.0}, {x, -y, 0.0}, {x, y, 0.0}, {-x, y, 0.0}}, {{0, 1, 2}, {0, 2, 3}}};
}

TriangleMesh make_capsule(double length, double radius) {
  constexpr std::uint32_t kSides = 24;
  constexpr std::uint32_t kRings = 16;  // half of them on each cap, the two at the equator apart
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < kRings; ++i) {
    const bool far_cap = i >= kRings / 2;
    const double latitude = std::numbers::pi * (far_cap ? i - 1 : i) / (kRings - 2);
    for (std::uint32_t j = 0; j < kSides; ++j) {
      const double longitude = 2.0 * std::numbers::pi * j / kSides;
      mesh.vertices.emplace_back(radius * std::sin(latitude) * std::cos(longitude),
                                 radius * std::sin(latitude) * std::sin(longitude),
                                 (far_cap ? length : 0.0) - radius * std::cos(latitude));
    }
  }
  for (std::uint32_t i = 0; i + 1 < kRings; ++i) {
    for (std::uint32_t j = 0; j < kSides; ++j) {
      const std::uint32_t a = i * kSides + j;
      const std::uint32_t b = i * kSides + (j + 1) % kSides;
      mesh.triangles.push_back({a, b, b + kSides});
      mesh.triangles.push_back({a, b + kSides, a + kSides});
    }
  }
  return mesh;
}

Eigen::Matrix3d rotation_along(const Eigen::Vector3d& direction) {
  const Eigen::Vector3d z = direction.normalized();
  const Eigen::Vector3d up =
      std::abs(z.y()) < 0.999 ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ();
  Eigen::Matrix3d R;
  R.col(0) = up.cross(z).normalized();
  R.col(1) = z.cross(R.col(0));
  R.col(2) = z;
  return R;
}

}  // namespace lockbox::simulation
