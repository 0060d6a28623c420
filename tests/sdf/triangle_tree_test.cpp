// SPDX-License-Identifier: BSD-3-Clause
#include "triangle_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lockbox/mesh/primitives.hpp"

namespace lockbox {
namespace {

double distance_to_nearest(const TriangleTree& tree, const Eigen::Vector3d& p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Corners& triangle : tree.corners()) {
    nearest = std::min(nearest, squared_distance(p, triangle));
  }
  return std::sqrt(nearest);
}

/// From one plate to another: on the way both are nearly as near.
TEST(TriangleTree, FollowsTheNearestTriangleExactly) {
  TriangleMesh plates;
  for (const double x : {-0.1, 0.1}) {
    const auto first = static_cast<std::uint32_t>(plates.vertices.size());
    for (const double y : {-0.05, 0.05}) {
      for (const double z : {-0.05, 0.05}) plates.vertices.emplace_back(x, y, z);
    }
    plates.triangles.push_back({first, first + 1, first + 2});
    plates.triangles.push_back({first + 1, first + 3, first + 2});
  }
  const TriangleTree tree(plates);
  std::uint32_t slot = 0;
  for (int i = -100; i <= 100; ++i) {
    const Eigen::Vector3d p(1e-5 * i, 0.01, 0.02);
    const double nearest = distance_to_nearest(tree, p);
    EXPECT_NEAR(tree.distance_beside(p, slot), nearest, 1e-12) << i;
    EXPECT_NEAR(std::sqrt(squared_distance(p, tree.corners()[slot])), nearest, 1e-12) << i;
  }
}

TEST(TriangleTree, TellsDistancesToAThousandth) {
  const TriangleTree tree(make_sphere(0.1));
  for (int i = 0; i <= 200; ++i) {
    const Eigen::Vector3d p(-0.2 + 0.002 * i, 0.07, 0.11);
    const double nearest = distance_to_nearest(tree, p);
    const double found = tree.distance(p);
    EXPECT_GE(found, nearest - 1e-12) << i;
    EXPECT_LE(found, 1.0011 * nearest) << i;
  }
}

}  // namespace
}  // namespace lockbox
