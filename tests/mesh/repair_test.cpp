// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/mesh/repair.hpp"

#include <gtest/gtest.h>

#include <random>

#include "lockbox/mesh/mesh_audit.hpp"
#include "lockbox/mesh/primitives.hpp"
#include "lockbox/mesh/topology.hpp"

namespace lockbox {
namespace {

using Eigen::Vector3d;

void turn(TriangleMesh& mesh, std::size_t t) {
  std::swap(mesh.triangles[t][0], mesh.triangles[t][1]);
}

TriangleMesh inside_out(TriangleMesh mesh) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    turn(mesh, t);
  }
  return mesh;
}

TriangleMesh soup_of(const TriangleMesh& mesh) {
  TriangleMesh soup;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    for (const Vector3d& corner : mesh.corners(t)) {
      soup.vertices.push_back(corner);
    }
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

TEST(Welding, ClosesASoup) {
  const TriangleMesh sphere = make_sphere(0.05);
  EXPECT_GT(audit(soup_of(sphere)).open_edges, 0U);
  const TriangleMesh mesh = welded(soup_of(sphere));
  EXPECT_EQ(mesh.vertices.size(), sphere.vertices.size());
  EXPECT_TRUE(audit(mesh).is_closed());
}

TEST(Welding, MergesVerticesThatRoundingSeparated) {
  TriangleMesh soup = soup_of(make_box({0.3, 0.2, 0.1}));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> noise(-5e-8, 5e-8);
  for (Vector3d& vertex : soup.vertices) {
    vertex += Vector3d(noise(random), noise(random), noise(random));
  }
  EXPECT_EQ(welded(soup).vertices.size(), 8U);
}

TEST(Welding, DropsWhatHasNoArea) {
  TriangleMesh mesh = make_box({1, 1, 1});
  mesh.vertices.emplace_back(0.0, 0.0, 0.0);  // of no triangle
  mesh.triangles.push_back({0, 0, 1});
  mesh.triangles.push_back({2, 5, 2});
  const TriangleMesh result = welded(mesh);
  EXPECT_EQ(result.triangles.size(), 12U);
  EXPECT_EQ(result.vertices.size(), 8U);
}

TEST(Welding, DropsTrianglesThatAreThereTwice) {
  TriangleMesh mesh = make_box({1, 1, 1});
  append(mesh, mesh);
  mesh.triangles.push_back({mesh.triangles[0][1], mesh.triangles[0][2], mesh.triangles[0][0]});
  EXPECT_EQ(welded(mesh).triangles, welded(make_box({1, 1, 1})).triangles);
}

TEST(Welding, OfNothingIsNothing) {
  EXPECT_TRUE(welded({}).triangles.empty());
}

TEST(Orientation, LeavesAGoodMeshAsItIs) {
  const TriangleMesh mesh = make_cylinder(0.02, 0.1);
  EXPECT_EQ(oriented_outwards(mesh).triangles, mesh.triangles);
}

TEST(Orientation, MendsATenthOfTheFaces) {
  TriangleMesh mesh = make_sphere(0.05);
  const double volume = signed_volume(mesh);
  std::mt19937 random(2);
  for (std::size_t i = 0; i < mesh.triangles.size() / 10; ++i) {
    turn(mesh, random() % mesh.triangles.size());
  }
  EXPECT_GT(audit(mesh).inconsistent_edges, 0U);
  const TriangleMesh mended = oriented_outwards(mesh);
  EXPECT_EQ(audit(mended).inconsistent_edges, 0U);
  EXPECT_NEAR(signed_volume(mended), volume, 1e-15);
}

TEST(Orientation, TurnsAnInsideOutMesh) {
  const TriangleMesh mesh = oriented_outwards(inside_out(make_box({0.1, 0.2, 0.3})));
  EXPECT_NEAR(signed_volume(mesh), 0.006, 1e-15);
}

TEST(Orientation, KeepsACavity) {
  TriangleMesh hollow = make_box({0.1, 0.1, 0.1});
  append(hollow, inside_out(make_box({0.08, 0.08, 0.08})));
  const double volume = 0.001 - 0.000512;
  EXPECT_NEAR(signed_volume(oriented_outwards(hollow)), volume, 1e-15);
  EXPECT_NEAR(signed_volume(oriented_outwards(inside_out(hollow))), volume, 1e-15);
}

TEST(Orientation, TurnsOnlyTheShellThatIsInsideOut) {
  TriangleMesh mesh = make_box({0.1, 0.1, 0.1});
  append(mesh, transformed(inside_out(make_box({0.1, 0.1, 0.1})),
                           Eigen::Isometry3d(Eigen::Translation3d(0.5, 0.0, 0.0))));
  EXPECT_NEAR(signed_volume(oriented_outwards(mesh)), 0.002, 1e-15);
}

TEST(Orientation, TurnsPatchesThatTogetherAreClosed) {
  // The six faces of a box, 0.1 mm apart from each other and all facing inwards.
  const TriangleMesh box = inside_out(make_box({0.1, 0.1, 0.1}));
  TriangleMesh patches = soup_of(box);
  for (std::size_t t = 0; t < patches.triangles.size(); ++t) {
    const Vector3d away = -1e-4 * area_vector(box.corners(t)).normalized();
    for (const std::uint32_t vertex : patches.triangles[t]) {
      patches.vertices[vertex] += away;
    }
  }
  const TriangleMesh mesh = oriented_outwards(welded(patches));
  EXPECT_EQ(audit(mesh).shells, 6U);
  EXPECT_GT(signed_volume(mesh), 0.0009);
}

TEST(Topology, FindsTheRimOfAHole) {
  TriangleMesh mesh = make_sphere(0.05);
  mesh.triangles.pop_back();
  EXPECT_EQ(audit(mesh).open_edges, 3U);
  const auto open = triangles_at_open_edges(mesh);
  EXPECT_EQ(std::count(open.begin(), open.end(), 1), 3);
}

TEST(Topology, CountsEdgesWithMoreThanTwoFaces) {
  TriangleMesh mesh = make_box({1, 1, 1});
  append(mesh, transformed(make_box({1, 1, 1}), Eigen::Isometry3d(Eigen::Translation3d(1, 1, 0))));
  const MeshAudit report = audit(welded(mesh));
  EXPECT_EQ(report.non_manifold_edges, 1U);
  EXPECT_EQ(report.open_edges, 0U);
}

TEST(EnclosesSolid, IsClosedManifoldAndLooksOutwards) {
  const TriangleMesh box = make_box({0.3, 0.2, 0.1});
  TriangleMesh two = box;
  append(two, make_sphere(0.3));
  EXPECT_TRUE(encloses_solid(box));
  EXPECT_TRUE(encloses_solid(two));
  EXPECT_FALSE(encloses_solid(inside_out(box)));
  EXPECT_FALSE(encloses_solid(soup_of(box)));
  EXPECT_FALSE(encloses_solid(TriangleMesh{}));
  TriangleMesh open = box;
  open.triangles.pop_back();
  EXPECT_FALSE(encloses_solid(open));
  TriangleMesh turned = box;
  turn(turned, 3);
  EXPECT_FALSE(encloses_solid(turned));
}

TEST(EnclosesSolid, KnowsACavityFromAShellInsideOut) {
  TriangleMesh hollow = make_box({0.3, 0.3, 0.3});
  append(hollow, inside_out(make_box({0.2, 0.2, 0.2})));
  EXPECT_TRUE(encloses_solid(hollow));
  EXPECT_FALSE(encloses_solid(inside_out(hollow)));
}

}  // namespace
}  // namespace lockbox
