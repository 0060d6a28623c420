// SPDX-License-Identifier: BSD-3-Clause
// Shapes and cameras that the renderer's tests share.
#pragma once

#include <cmath>
#include <numbers>

#include "lockbox/core/pinhole_camera.hpp"
#include "lockbox/mesh/triangle_mesh.hpp"

namespace lockbox::testing {

inline PinholeCamera vga_camera() {
  return {640, 480, 575.8, 575.8, 319.5, 239.5};
}

/// A rectangle in z = 0 around the origin.
inline TriangleMesh rectangle(double width, double height) {
  const double x = 0.5 * width;
  const double y = 0.5 * height;
  return {{{-x, -y, 0.0}, {x, -y, 0.0}, {x, y, 0.0}, {-x, y, 0.0}}, {{0, 1, 2}, {0, 2, 3}}};
}

/// A sphere around the origin with rings of triangles from pole to pole; its vertices lie on it.
inline TriangleMesh ball(double radius, std::uint32_t rings) {
  TriangleMesh mesh;
  const std::uint32_t sides = 2 * rings;
  for (std::uint32_t i = 0; i <= rings; ++i) {
    for (std::uint32_t j = 0; j < sides; ++j) {
      const double latitude = std::numbers::pi * i / rings;
      const double longitude = std::numbers::pi * j / rings;
      mesh.vertices.emplace_back(radius * std::sin(latitude) * std::cos(longitude),
                                 radius * std::sin(latitude) * std::sin(longitude),
                                 radius * std::cos(latitude));
    }
  }
  for (std::uint32_t i = 0; i < rings; ++i) {
    for (std::uint32_t j = 0; j < sides; ++j) {
      const std::uint32_t next = (j + 1) % sides;
      mesh.triangles.push_back({i * sides + j, (i + 1) * sides + j, (i + 1) * sides + next});
      mesh.triangles.push_back({i * sides + j, (i + 1) * sides + next, i * sides + next});
    }
  }
  return mesh;
}

}  // namespace lockbox::testing
