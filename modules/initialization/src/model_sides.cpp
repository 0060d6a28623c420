// SPDX-License-Identifier: BSD-3-Clause
#include "model_sides.hpp"

#include <algorithm>
#include <numeric>

#include "lockbox/model/forward_kinematics.hpp"

namespace lockbox {
namespace {

/// Share of the area of the largest side that faces the same way: worth looking for. Doubled, the
/// narrower of two doors is not.
constexpr double kLeastShare = 0.25;
constexpr double kSameWay = 0.87;  // cosine of 30 degrees: seen together, or not
/// The same of the largest side that faces another way. Doubled, chests of eight drawers have no
/// fronts; halved, boards have narrow sides, by which none is found, and the search takes twice as
/// long.
constexpr double kLeastShareOfAll = 0.06;
/// Shares of the square of the model's diameter, and of its surface, of which the smaller is the
/// area of a flat side that can be told in a view: 4 cm by 5 cm of a metre. Doubled, narrow
/// sides of large models are no longer matched; halved, the search takes longer for round ones.
constexpr double kLeastOfSquare = 0.002;
constexpr double kLeastOfSurface = 0.002;

double surface_of(const KinematicTree& tree) {
  return std::accumulate(
      tree.bodies.begin(), tree.bodies.end(), 0.0,
      [](double sum, const Body& body) { return sum + surface_area(body.mesh); });
}

}  // namespace

bool is_large(const Facing& side, const std::vector<Facing>& sides) {
  return std::all_of(sides.begin(), sides.end(), [&](const Facing& other) {
    const bool is_seen_with = other.normal.dot(side.normal) > kSameWay;
    return side.area >= (is_seen_with ? kLeastShare : kLeastShareOfAll) * other.area;
  });
}

std::vector<ModelSide> flat_sides(const KinematicTree& tree) {
  std::vector<Eigen::Isometry3d> poses;
  const Configuration rest = rest_configuration(tree);
  forward_kinematics(tree, rest, poses);
  Eigen::AlignedBox3d box;
  for (std::size_t b = 0; b < poses.size(); ++b) {
    poses[b] = rest.T_camera_base.inverse() * poses[b];
    for (const auto& vertex : tree.bodies[b].mesh.vertices) box.extend(poses[b] * vertex);
  }
  const double least =
      std::min(kLeastOfSquare * box.diagonal().squaredNorm(), kLeastOfSurface * surface_of(tree));
  std::vector<ModelSide> sides;
  for (std::size_t b = 0; b < poses.size(); ++b) {
    for (const FlatSide& side : flat_sides(tree.bodies[b].mesh, least)) {
      sides.push_back({static_cast<int>(b), side, poses[b].linear() * side.normal});
    }
  }
  return sides;
}

double flat_share(const KinematicTree& tree) {
  const std::vector<ModelSide> sides = flat_sides(tree);
  const double flat =
      std::accumulate(sides.begin(), sides.end(), 0.0,
                      [](double sum, const ModelSide& side) { return sum + side.flat.area; });
  return flat / surface_of(tree);
}

}  // namespace lockbox
