// SPDX-License-Identifier: BSD-3-Clause
#include "winding_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lockbox/mesh/topology.hpp"
#include "lockbox/mesh/winding.hpp"

namespace lockbox {
namespace {

bool has_no_open_edge(const TriangleMesh& mesh) {
  const auto open = triangles_at_open_edges(mesh);
  return std::none_of(open.begin(), open.end(), [](std::uint8_t is_open) { return is_open != 0; });
}

}  // namespace

WindingTree::WindingTree(const TriangleMesh& mesh)
    : tree_(mesh), is_closed_(has_no_open_edge(mesh)) {
  dipoles_.reserve(tree_.nodes().size());
  for (const TriangleTree::Node& node : tree_.nodes()) {
    Dipole dipole{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 0.0};
    double total_area = 0.0;
    for (std::uint32_t slot = node.begin; slot < node.end; ++slot) {
      const auto& [a, b, c] = tree_.corners()[slot];
      const Eigen::Vector3d area = area_vector({a, b, c});
      dipole.area += area;
      dipole.centre += area.norm() / 3.0 * (a + b + c);
      total_area += area.norm();
    }
    dipole.centre /= total_area;
    for (std::uint32_t slot = node.begin; slot < node.end; ++slot) {
      for (const Eigen::Vector3d& corner : tree_.corners()[slot]) {
        dipole.radius = std::max(dipole.radius, (corner - dipole.centre).norm());
      }
    }
    dipoles_.push_back(dipole);
  }
}

double WindingTree::operator()(const Eigen::Vector3d& p, double far) const {
  return solid_angle_of(0, p, far) / (4.0 * std::numbers::pi);
}

double WindingTree::counted(const Eigen::Vector3d& p) const {
  // Directions that CAD faces are unlikely to lie along; where one meets an edge, try the next.
  static const std::array<Eigen::Vector3d, 3> kDirections = {
      Eigen::Vector3d(0.2831, 0.5417, 0.7915).normalized(),
      Eigen::Vector3d(-0.7393, 0.6121, 0.2806).normalized(),
      Eigen::Vector3d(0.5779, -0.3613, -0.7317).normalized()};
  if (is_closed_) {
    for (const Eigen::Vector3d& direction : kDirections) {
      if (const auto exits = tree_.net_exits(p, direction)) {
        return *exits;
      }
    }
  }
  return (*this)(p);
}

double WindingTree::solid_angle_of(std::uint32_t node, const Eigen::Vector3d& p, double far) const {
  const Dipole& dipole = dipoles_[node];
  const Eigen::Vector3d offset = dipole.centre - p;
  const double squared = offset.squaredNorm();
  if (squared > far * far * dipole.radius * dipole.radius) {
    return dipole.area.dot(offset) / (squared * std::sqrt(squared));
  }
  const TriangleTree::Node& range = tree_.nodes()[node];
  if (range.right != 0) {
    return solid_angle_of(node + 1, p, far) + solid_angle_of(range.right, p, far);
  }
  double sum = 0.0;
  for (std::uint32_t slot = range.begin; slot < range.end; ++slot) {
    const auto& [a, b, c] = tree_.corners()[slot];
    sum += solid_angle(a - p, b - p, c - p);
  }
  return sum;
}

}  // namespace lockbox
