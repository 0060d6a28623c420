// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/mesh/repair.hpp"

#include <gtest/gtest.h>

#include <algorithm>
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

/// A board within a wall of its length and height, as a URDF of boxes has it: one face is both's.
TEST(Welding, KeepsAFaceThatTwoOverlappingSolidsShare) {
  const auto moved = [](TriangleMesh mesh, double x) {
    for (Eigen::Vector3d& vertex : mesh.vertices) vertex.x() += x;
    return mesh;
  };
  TriangleMesh mesh = moved(make_box({0.1, 0.3, 0.2}), -0.05);
  append(mesh, moved(make_box({0.02, 0.3, 0.2}), -0.01));
  EXPECT_EQ(welded(mesh).triangles.size(), mesh.triangles.size());
  const auto open = triangles_at_open_edges(welded(mesh));
  EXPECT_EQ(std::count(open.begin(), open.end(), 1), 0);
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

/// Without the triangles that touch a vertex.
TriangleMesh without_vertex(TriangleMesh mesh, std::uint32_t vertex) {
  std::erase_if(mesh.triangles, [&](const auto& triangle) {
    return std::find(triangle.begin(), triangle.end(), vertex) != triangle.end();
  });
  return mesh;
}

TEST(SmallHoles, AreClosed) {
  const TriangleMesh sphere = make_sphere(0.05);
  TriangleMesh mesh = sphere;
  mesh.triangles.pop_back();
  for (const std::uint32_t vertex : {100U, 300U, 500U}) mesh = without_vertex(mesh, vertex);
  ASSERT_GT(audit(mesh).open_edges, 15U);
  const TriangleMesh closed = with_small_holes_closed(mesh);
  EXPECT_TRUE(encloses_solid(closed));
  EXPECT_NEAR(signed_volume(closed), signed_volume(sphere), 0.002 * signed_volume(sphere));
}

TEST(SmallHoles, LargeOnesMayBeMeant) {
  for (TriangleMesh mesh : {make_box({0.1, 0.1, 0.1}), make_cylinder(0.02, 0.1)}) {
    mesh.triangles.pop_back();
    mesh.triangles.pop_back();
    EXPECT_EQ(with_small_holes_closed(mesh).triangles, mesh.triangles);
  }
  const TriangleMesh sheet{{{0, 0, 0}, {0.1, 0, 0}, {0.1, 0.1, 0}, {0, 0.1, 0}},
                           {{0, 1, 2}, {0, 2, 3}}};
  EXPECT_EQ(with_small_holes_closed(sheet).triangles, sheet.triangles);
}

TEST(SmallHoles, AreMeasuredByTheirShellAndNotByTheMesh) {
  TriangleMesh mesh = make_box({1.0, 1.0, 1.0});
  TriangleMesh small = make_box({0.01, 0.01, 0.01});
  small.triangles.pop_back();
  append(mesh, small);
  EXPECT_EQ(with_small_holes_closed(mesh).triangles, mesh.triangles);
}

TEST(SmallHoles, StayWhereThereAreTooMany) {
  TriangleMesh mesh = make_sphere(0.05);
  std::erase_if(mesh.triangles, [i = 0](const auto&) mutable { return i++ % 4 == 0; });
  const TriangleMesh result = with_small_holes_closed(mesh);
  EXPECT_EQ(result.triangles, mesh.triangles);
}

TEST(SmallHoles, StayWhereTheirBordersMeet) {
  // Two triangles that share a vertex only.
  TriangleMesh mesh = make_sphere(0.05);
  const auto first = mesh.triangles[1000];
  std::size_t removed = 0;
  std::erase_if(mesh.triangles, [&](const auto& triangle) {
    const auto shared = std::count_if(triangle.begin(), triangle.end(), [&](std::uint32_t v) {
      return std::find(first.begin(), first.end(), v) != first.end();
    });
    const bool is_first = shared == 3;
    const bool is_second = shared == 1 && removed == 0 &&
                           std::find(triangle.begin(), triangle.end(), first[0]) != triangle.end();
    removed += is_second ? 1 : 0;
    return is_first || is_second;
  });
  ASSERT_EQ(audit(mesh).open_edges, 6U);
  EXPECT_EQ(with_small_holes_closed(mesh).triangles, mesh.triangles);
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
