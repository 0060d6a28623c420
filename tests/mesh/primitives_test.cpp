// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/mesh/primitives.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "lockbox/core/error.hpp"
#include "lockbox/mesh/content_hash.hpp"
#include "lockbox/mesh/mesh_audit.hpp"
#include "lockbox/mesh/winding.hpp"

namespace lockbox {
namespace {

using Eigen::Vector3d;

TEST(Primitives, BoxIsClosedAndExact) {
  const MeshAudit report = audit(make_box({0.2, 0.1, 0.05}));
  EXPECT_TRUE(report.is_closed());
  EXPECT_EQ(report.shells, 1U);
  EXPECT_EQ(report.non_manifold_edges, 0U);
  EXPECT_NEAR(report.volume, 0.2 * 0.1 * 0.05, 1e-15);
  EXPECT_NEAR(report.area, 2.0 * (0.02 + 0.01 + 0.005), 1e-15);
  EXPECT_TRUE(report.bounds.min().isApprox(Vector3d(-0.1, -0.05, -0.025)));
}

TEST(Primitives, CylinderStaysWithinItsChordError) {
  for (const double radius : {0.002, 0.02, 0.3}) {
    const MeshAudit report = audit(make_cylinder(radius, 0.1));
    EXPECT_TRUE(report.is_closed());
    const double ideal = std::numbers::pi * radius * radius * 0.1;
    const double inner = std::numbers::pi * (radius - 5e-5) * (radius - 5e-5) * 0.1;
    EXPECT_LE(report.volume, ideal);
    EXPECT_GE(report.volume, inner);
    EXPECT_TRUE(report.bounds.max().isApprox(Vector3d(radius, radius, 0.05)));
  }
}

TEST(Primitives, CylindersHaveNoMoreSidesThanTheLimitHoweverLargeTheyAre) {
  EXPECT_EQ(make_cylinder(1e30, 0.1).triangles.size(), make_cylinder(1e3, 0.1).triangles.size());
}

TEST(Primitives, SphereStaysWithinItsChordError) {
  for (const double radius : {0.005, 0.05, 0.4}) {
    const TriangleMesh mesh = make_sphere(radius);
    EXPECT_TRUE(audit(mesh).is_closed());
    EXPECT_GT(signed_volume(mesh), 0.0);
    double largest_sagitta = 0.0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto [a, b, c] = mesh.corners(t);
      ASSERT_NEAR(a.norm(), radius, 1e-12);
      largest_sagitta = std::max(largest_sagitta, radius - (a + b + c).norm() / 3.0);
    }
    EXPECT_LE(largest_sagitta, 1e-4);
  }
}

TEST(Primitives, RefuseSizesWithoutMeaning) {
  EXPECT_THROW(make_box({0.1, 0.0, 0.1}), InputError);
  EXPECT_THROW(make_box({0.1, -0.1, 0.1}), InputError);
  EXPECT_THROW(make_cylinder(std::nan(""), 0.1), InputError);
  EXPECT_THROW(make_cylinder(0.1, 0.0), InputError);
  EXPECT_THROW(make_sphere(std::numeric_limits<double>::infinity()), InputError);
}

TEST(TriangleMesh, MovesWithItsVolume) {
  const Eigen::Isometry3d T_a_b = Eigen::Translation3d(100.0, -20.0, 3.0) *
                                  Eigen::AngleAxisd(1.0, Vector3d(1, 2, 3).normalized());
  const TriangleMesh moved = transformed(make_box({0.02, 0.03, 0.04}), T_a_b);
  EXPECT_NEAR(signed_volume(moved), 0.02 * 0.03 * 0.04, 1e-13);
  EXPECT_TRUE(moved.vertices[0].isApprox(T_a_b * Vector3d(-0.01, -0.015, -0.02)));
}

TEST(TriangleMesh, AppendingKeepsBothParts) {
  TriangleMesh mesh = make_box({1, 1, 1});
  append(mesh, transformed(make_box({1, 1, 1}), Eigen::Isometry3d(Eigen::Translation3d(2, 0, 0))));
  EXPECT_NEAR(signed_volume(mesh), 2.0, 1e-12);
  EXPECT_EQ(audit(mesh).shells, 2U);
}

TEST(WindingNumber, IsOneInsideAndZeroOutside) {
  const TriangleMesh box = make_box({0.2, 0.2, 0.2});
  EXPECT_NEAR(winding_number(box, Vector3d(0.09, -0.09, 0.0999)), 1.0, 1e-12);
  EXPECT_NEAR(winding_number(box, Vector3d(0.09, -0.09, 0.1001)), 0.0, 1e-12);
}

TEST(ContentHash, TellsMeshesApart) {
  const TriangleMesh box = make_box({0.2, 0.1, 0.05});
  TriangleMesh changed = box;
  EXPECT_EQ(content_hash(box), content_hash(changed));
  changed.vertices[3].y() = std::nextafter(changed.vertices[3].y(), 1.0);
  EXPECT_NE(content_hash(box), content_hash(changed));
  changed = box;
  std::swap(changed.triangles[0][0], changed.triangles[0][1]);
  EXPECT_NE(content_hash(box), content_hash(changed));
}

TEST(ContentHash, HasATextOfOneLength) {
  EXPECT_EQ(hash_text(0x1f), "000000000000001f");
  EXPECT_EQ(hash_text(~std::uint64_t{0}), "ffffffffffffffff");
}

TEST(ContentHash, IgnoresTheSignOfZero) {
  TriangleMesh plus{{Vector3d(0.0, 1.0, 2.0)}, {}};
  TriangleMesh minus{{Vector3d(-0.0, 1.0, 2.0)}, {}};
  EXPECT_EQ(content_hash(plus), content_hash(minus));
}

}  // namespace
}  // namespace lockbox
