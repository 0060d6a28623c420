// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/mesh/winding.hpp"

#include <cmath>
#include <numbers>

namespace lockbox {

double solid_angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const double la = a.norm();
  const double lb = b.norm();
  const double lc = c.norm();
  const double numerator = a.dot(b.cross(c));
  const double denominator = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
  return 2.0 * std::atan2(numerator, denominator);
}

double winding_number(const TriangleMesh& mesh, const Eigen::Vector3d& p) {
  double sum = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [a, b, c] = mesh.corners(t);
    sum += solid_angle(a - p, b - p, c - p);
  }
  return sum / (4.0 * std::numbers::pi);
}

}  // namespace lockbox
