// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/mesh/primitives.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include "lockbox/core/error.hpp"
#include "lockbox/core/number_text.hpp"

namespace lockbox {
namespace {

void require_length(double value, const std::string& shape, const std::string& name) {
  if (!std::isfinite(value) || value <= 0.0) {
    throw InputError(shape, name + " is " + fixed_number_text(value) +
                                "; it must be a positive number of metres");
  }
}

std::uint32_t sides_of_cylinder(double radius) {
  constexpr double kSagitta = 5e-5;
  const double half_angle = std::acos(1.0 - std::min(kSagitta / radius, 0.5));
  // A multiple of four puts vertices on the axes, so that the bounds are those of the cylinder.
  // Of a radius without measure the angle is 0, and this infinite.
  const double quarter = std::ceil(std::numbers::pi / half_angle / 4.0);
  return 4 * static_cast<std::uint32_t>(std::clamp(quarter, 6.0, 64.0));
}

/// One triangle becomes four; new vertices, one an edge, are pushed out to the sphere.
TriangleMesh subdivided_on_sphere(TriangleMesh mesh, double radius) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> midpoints;
  const auto midpoint = [&](std::uint32_t a, std::uint32_t b) {
    const auto next = static_cast<std::uint32_t>(mesh.vertices.size());
    const auto [entry, is_new] = midpoints.try_emplace(std::minmax(a, b), next);
    if (is_new) {
      mesh.vertices.emplace_back(radius * (mesh.vertices[a] + mesh.vertices[b]).normalized());
    }
    return entry->second;
  };
  std::vector<std::array<std::uint32_t, 3>> triangles;
  triangles.reserve(4 * mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::uint32_t ab = midpoint(a, b);
    const std::uint32_t bc = midpoint(b, c);
    const std::uint32_t ca = midpoint(c, a);
    triangles.insert(triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  mesh.triangles = std::move(triangles);
  return mesh;
}

/// How far the middle of the largest face lies inside the sphere, metres.
double sagitta_of_sphere(const TriangleMesh& mesh, double radius) {
  double sagitta = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [a, b, c] = mesh.corners(t);
    sagitta = std::max(sagitta, radius - (a + b + c).norm() / 3.0);
  }
  return sagitta;
}

}  // namespace

TriangleMesh make_box(const Eigen::Vector3d& size) {
  for (int axis = 0; axis < 3; ++axis) {
    require_length(size[axis], "box", std::string("size along ") + "xyz"[axis]);
  }
  TriangleMesh mesh;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d side((corner & 1) != 0 ? 0.5 : -0.5, (corner & 2) != 0 ? 0.5 : -0.5,
                               (corner & 4) != 0 ? 0.5 : -0.5);
    mesh.vertices.emplace_back(size.cwiseProduct(side));
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

TriangleMesh make_cylinder(double radius, double length) {
  require_length(radius, "cylinder", "radius");
  require_length(length, "cylinder", "length");
  const std::uint32_t sides = sides_of_cylinder(radius);
  TriangleMesh mesh;
  mesh.vertices = {{0.0, 0.0, -0.5 * length}, {0.0, 0.0, 0.5 * length}};
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / sides;
    const double x = radius * std::cos(angle);
    const double y = radius * std::sin(angle);
    mesh.vertices.emplace_back(x, y, -0.5 * length);
    mesh.vertices.emplace_back(x, y, 0.5 * length);
    const std::uint32_t low = 2 + 2 * i;
    const std::uint32_t next = 2 + 2 * ((i + 1) % sides);
    mesh.triangles.insert(
        mesh.triangles.end(),
        {{0, next, low}, {1, low + 1, next + 1}, {low, next, next + 1}, {low, next + 1, low + 1}});
  }
  return mesh;
}

TriangleMesh make_sphere(double radius) {
  require_length(radius, "sphere", "radius");
  constexpr double kSagitta = 1e-4;
  constexpr int kMinLevels = 3;
  constexpr int kMaxLevels = 6;
  TriangleMesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    mesh.vertices.emplace_back(radius * Eigen::Vector3d::Unit(axis));
    mesh.vertices.emplace_back(-radius * Eigen::Vector3d::Unit(axis));
  }
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                    {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < kMaxLevels; ++level) {
    if (level >= kMinLevels && sagitta_of_sphere(mesh, radius) <= kSagitta) {
      break;
    }
    mesh = subdivided_on_sphere(std::move(mesh), radius);
  }
  return mesh;
}

}  // namespace lockbox
