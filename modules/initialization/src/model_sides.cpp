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

std::vector<Eigen::Isometry3d> poses_at_rest(const KinematicTree& tree) {
  std::vector<Eigen::Isometry3d> poses;
  forward_kinematics(tree, rest_configuration(tree), poses);
  const Eigen::Isometry3d T_base_camera = poses.front().inverse();
  for (Eigen::Isometry3d& pose : poses) pose = T_base_camera * pose;
  return poses;
}

/// Those that can be told in a view.
std::vector<ModelSide> all_sides(const KinematicTree& tree) {
  Eigen::AlignedBox3d box;
  const std::vector<Eigen::Isometry3d> poses = poses_at_rest(tree);
  for (std::size_t b = 0; b < poses.size(); ++b) {
    for (const auto& vertex : tree.bodies[b].mesh.vertices) box.extend(poses[b] * vertex);
  }
  const double least =
      std::min(kLeastOfSquare * box.diagonal().squaredNorm(), kLeastOfSurface * surface_of(tree));
  std::vector<ModelSide> sides;
  for (std::size_t b = 0; b < poses.size(); ++b) {
    for (const FlatSide& side : flat_sides(tree.bodies[b].mesh, least)) {
      sides.push_back({static_cast<int>(b), side});
    }
  }
  return sides;
}

}  // namespace

bool is_large(const Facing& side, const std::vector<Facing>& sides) {
  return std::all_of(sides.begin(), sides.end(), [&](const Facing& other) {
    return other.normal.dot(side.normal) < kSameWay || side.area >= kLeastShare * other.area;
  });
}

std::vector<ModelSide> large_sides(const KinematicTree& tree) {
  const std::vector<Eigen::Isometry3d> poses = poses_at_rest(tree);
  const std::vector<ModelSide> sides = all_sides(tree);
  std::vector<Facing> facings;
  for (const auto& [body, side] : sides) {
    facings.push_back({poses[static_cast<std::size_t>(body)].linear() * side.normal, side.area});
  }
  std::vector<ModelSide> large;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (is_large(facings[i], facings)) large.push_back(sides[i]);
  }
  return large;
}

double flat_share(const KinematicTree& tree) {
  const std::vector<ModelSide> sides = all_sides(tree);
  const double flat =
      std::accumulate(sides.begin(), sides.end(), 0.0,
                      [](double sum, const ModelSide& side) { return sum + side.flat.area; });
  return flat / surface_of(tree);
}

}  // namespace lockbox
