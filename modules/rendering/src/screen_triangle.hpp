// SPDX-License-Identifier: BSD-3-Clause
// A triangle prepared for scan conversion.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "lockbox/core/pinhole_camera.hpp"

namespace lockbox::rendering {

/// A vertex in the camera's frame (metres) and its projection (pixels, 1/metres). The projection
/// is not valid in front of the near plane.
struct Vertex {
  Eigen::Vector3d p_camera;
  double u;
  double v;
  double inverse_z;
  int column;  ///< of the first pixel centres that are not before it, nor outside of the image
  int row;
};

Vertex projected(const PinholeCamera& camera, const Eigen::Vector3d& p_camera);

/// The line of an edge as a function of the row. It starts at the edge's upper end, whichever
/// triangle it belongs to: neighbours compute the very same columns.
struct Edge {
  double u;
  double v;
  double slope;  ///< columns a row

  double column(int row) const { return u + (row - v) * slope; }
};

/// Covers, in each row of [first_row, end_row), the pixel centres between two of its edges.
struct ScreenTriangle {
  Edge whole;  ///< from the top vertex to the bottom one
  Edge upper;  ///< from the top vertex to the middle one: rows before middle_row
  Edge lower;  ///< from the middle vertex to the bottom one
  int first_row;
  int middle_row;
  int end_row;
  int first_column;  ///< all pixel centres are in [first_column, end_column)
  int end_column;
  bool whole_is_left;

  /// inverse_z(u, v) = inverse_z + (u - u0) du + (v - v0) dv, within [low, high].
  double u0;
  double v0;
  double inverse_z;
  double du;
  double dv;
  float low;
  float high;
  std::int16_t id;
};

/// Whether the camera sees the side from which the vertices run counter-clockwise. All three lie
/// behind the near plane.
inline bool shows_front(const Vertex& a, const Vertex& b, const Vertex& c) {
  return (b.u - a.u) * (c.v - a.v) < (c.u - a.u) * (b.v - a.v);
}

/// Appends the part of the triangle behind the near plane, as up to two screen triangles; nothing
/// if it covers no pixel centre of the image.
void append_screen_triangles(const PinholeCamera& camera, double near, const Vertex& a,
                             const Vertex& b, const Vertex& c, std::int16_t id,
                             std::vector<ScreenTriangle>& triangles);

/// The first of the integers 0 ... count that is not below x; 0 for NaN.
inline int first_centre(double x, int count) {
  const double last = count;
  const double clamped = x > 0.0 ? (x < last ? x : last) : 0.0;
  const int truncated = static_cast<int>(clamped);
  return truncated + (clamped > truncated ? 1 : 0);
}

}  // namespace lockbox::rendering
