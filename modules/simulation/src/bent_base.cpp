// SPDX-License-Identifier: BSD-3-Clause
#include "bent_base.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

namespace lockbox::simulation {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

/// Splits edges at their middles, each once.
class EdgeSplitter {
 public:
  EdgeSplitter(TriangleMesh& mesh, double longest) : mesh_(mesh), longest_(longest) {}

  bool is_long(std::uint32_t a, std::uint32_t b) const {
    return (mesh_.vertices[a] - mesh_.vertices[b]).norm() > longest_;
  }

  std::uint32_t middle(std::uint32_t a, std::uint32_t b) {
    const auto key = std::minmax(a, b);
    const auto [found, is_new] =
        middles_.emplace(key, static_cast<std::uint32_t>(mesh_.vertices.size()));
    if (is_new) {
      const Eigen::Vector3d point = 0.5 * (mesh_.vertices[a] + mesh_.vertices[b]);
      mesh_.vertices.push_back(point);
    }
    return found->second;
  }

 private:
  TriangleMesh& mesh_;
  double longest_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles_;
};

/// Cuts off the corners whose both edges are split, else from the split edge to the corner.
void split(const Triangle& triangle, EdgeSplitter& edges, std::vector<Triangle>& parts) {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t a = triangle[i];
    const std::uint32_t b = triangle[(i + 1) % 3];
    const std::uint32_t c = triangle[(i + 2) % 3];
    if (!edges.is_long(a, b)) continue;
    const std::uint32_t ab = edges.middle(a, b);
    if (edges.is_long(b, c) && edges.is_long(c, a)) {
      const std::uint32_t bc = edges.middle(b, c);
      const std::uint32_t ca = edges.middle(c, a);
      parts.insert(parts.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    } else if (edges.is_long(b, c)) {
      const std::uint32_t bc = edges.middle(b, c);
      parts.insert(parts.end(), {{ab, b, bc}, {a, ab, bc}, {a, bc, c}});
    } else if (edges.is_long(c, a)) {
      continue;  // this pair of edges begins at the next one but one
    } else {
      parts.insert(parts.end(), {{a, ab, c}, {ab, b, c}});
    }
    return;
  }
  parts.push_back(triangle);
}

}  // namespace

TriangleMesh with_short_edges(TriangleMesh mesh, double longest) {
  for (std::size_t before = 0; before != mesh.triangles.size();) {
    before = mesh.triangles.size();
    EdgeSplitter edges(mesh, longest);
    std::vector<Triangle> parts;
    for (const Triangle& triangle : mesh.triangles) split(triangle, edges, parts);
    mesh.triangles = std::move(parts);
  }
  return mesh;
}

void bend_base(KinematicTree& tree, double bow) {
  const Eigen::AlignedBox3d box = bounds(tree.bodies[0].mesh);
  Eigen::Index along = 0;
  Eigen::Index across = 0;
  if (box.isEmpty() || box.sizes().maxCoeff(&along) <= 0.0) return;
  box.sizes().minCoeff(&across);
  if (along == across) across = (along + 1) % 3;  // a cube
  const double half = 0.5 * box.sizes()[along];
  const auto share = [&](const Eigen::Vector3d& point) {
    return std::clamp((point[along] - box.center()[along]) / half, -1.0, 1.0);
  };
  for (Eigen::Vector3d& vertex : tree.bodies[0].mesh.vertices) {
    vertex[across] += bow * (1.0 - share(vertex) * share(vertex));
  }
  const Eigen::Vector3d axis = Eigen::Vector3d::Unit(along).cross(Eigen::Vector3d::Unit(across));
  for (Joint& joint : tree.joints) {
    if (joint.parent_body != 0) continue;
    const Eigen::Vector3d origin = joint.T_parent_joint.translation();
    const double slope = -2.0 * bow * share(origin) / half;
    joint.T_parent_joint.translation()[across] += bow * (1.0 - share(origin) * share(origin));
    joint.T_parent_joint.linear() =
        Eigen::AngleAxisd(std::atan(slope), axis) * joint.T_parent_joint.linear();
  }
}

}  // namespace lockbox::simulation
