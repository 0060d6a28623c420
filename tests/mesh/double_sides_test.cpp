// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "lockbox/mesh/mesh_audit.hpp"
#include "lockbox/mesh/primitives.hpp"
#include "lockbox/mesh/repair.hpp"

namespace lockbox {
namespace {

/// The mesh with its first count triangles for the other side, too, in front of all others.
TriangleMesh doubled(const TriangleMesh& mesh, std::size_t count) {
  TriangleMesh result{mesh.vertices, {}};
  for (std::size_t t = 0; t < count; ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    result.triangles.push_back({c, b, a});
  }
  append(result, mesh);
  return welded(result);
}

TEST(OneSided, DropsTheOtherSideOfAWholeMesh) {
  const TriangleMesh sphere = make_sphere(0.1);
  const TriangleMesh mesh = one_sided(doubled(sphere, sphere.triangles.size()));
  EXPECT_TRUE(encloses_solid(mesh));
  EXPECT_NEAR(signed_volume(mesh), signed_volume(sphere), 1e-12);
}

TEST(OneSided, DropsTheOtherSideOfAPart) {
  const TriangleMesh box = make_box({0.3, 0.2, 0.1});
  for (std::size_t count = 1; count < box.triangles.size(); ++count) {
    const TriangleMesh mesh = one_sided(doubled(box, count));
    EXPECT_TRUE(encloses_solid(mesh)) << count;
    EXPECT_NEAR(signed_volume(mesh), 0.006, 1e-12) << count;
  }
}

TEST(OneSided, KeepsTheFaceInWhichTwoSolidsTouch) {
  TriangleMesh mesh = make_box({0.1, 0.1, 0.1});
  for (Eigen::Vector3d& vertex : mesh.vertices) vertex.x() = 0.1 - vertex.x();
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  append(mesh, make_box({0.1, 0.1, 0.1}));  // the mirror image of the first, beside it
  const TriangleMesh touching = welded(mesh);
  ASSERT_EQ(touching.vertices.size(), 12U);
  EXPECT_EQ(one_sided(touching).triangles, touching.triangles);
}

TEST(OneSided, LeavesAMeshWithOneSideAsItIs) {
  const TriangleMesh mesh = make_cylinder(0.02, 0.1);
  EXPECT_EQ(one_sided(mesh).triangles, mesh.triangles);
}

}  // namespace
}  // namespace lockbox
