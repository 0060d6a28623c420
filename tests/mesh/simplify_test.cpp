// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/mesh/simplify.hpp"

#include <gtest/gtest.h>

#include "lockbox/mesh/primitives.hpp"

namespace lockbox {
namespace {

TEST(Simplified, SphereKeepsItsShape) {
  const TriangleMesh sphere = make_sphere(0.1);
  ASSERT_GT(sphere.triangles.size(), 1000U);
  const TriangleMesh simple = simplified(sphere, 500);
  EXPECT_LE(simple.triangles.size(), 510U);
  EXPECT_GT(simple.triangles.size(), 400U);
  for (const Eigen::Vector3d& vertex : simple.vertices) EXPECT_NEAR(vertex.norm(), 0.1, 0.002);
  EXPECT_NEAR(signed_volume(simple), signed_volume(sphere), 0.02 * signed_volume(sphere));
}

TEST(Simplified, MeshOfFewTrianglesIsTheSame) {
  const TriangleMesh box = make_box({0.1, 0.2, 0.3});
  const TriangleMesh same = simplified(box, box.triangles.size());
  EXPECT_EQ(same.triangles, box.triangles);
  EXPECT_EQ(same.vertices, box.vertices);
}

}  // namespace
}  // namespace lockbox
