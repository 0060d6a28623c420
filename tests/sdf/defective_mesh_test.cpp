// SPDX-License-Identifier: BSD-3-Clause
// What CAD exports do to a solid: repaired or refused, never silently hollow.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <utility>

#include "field_fixture.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/mesh/primitives.hpp"

namespace lockbox {
namespace {

using testing::AllOf;
using testing::HasSubstr;

void turn(TriangleMesh& mesh, std::size_t t) {
  std::swap(mesh.triangles[t][0], mesh.triangles[t][1]);
}

TriangleMesh inside_out(TriangleMesh mesh) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    turn(mesh, t);
  }
  return mesh;
}

/// Every triangle with vertices of its own, moved outwards by gap metres.
TriangleMesh torn(const TriangleMesh& mesh, double gap) {
  TriangleMesh soup;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    const Eigen::Vector3d away = gap * area_vector(mesh.corners(t)).normalized();
    for (const Eigen::Vector3d& corner : mesh.corners(t)) {
      soup.vertices.emplace_back(corner + away);
    }
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

void expect_like(const SignedDistanceField& field, const TriangleMesh& good) {
  const SurfaceErrors errors = surface_errors(field, good);
  EXPECT_LT(std::abs(volume_error(field, signed_volume(good))), 0.01);
  EXPECT_LT(errors.mean_distance, 0.1);
  EXPECT_EQ(errors.wrong_signs, 0.0);
}

std::string refusal(const TriangleMesh& mesh) {
  try {
    field_of(mesh);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(DefectiveMesh, SoupIsWelded) {
  const TriangleMesh good = make_cylinder(0.012, 0.03);
  expect_like(field_of(torn(good, 0.0)), good);
}

TEST(DefectiveMesh, SmallGapsAreClosed) {
  const TriangleMesh good = make_box({0.04, 0.03, 0.02});
  expect_like(field_of(torn(good, 2e-5), 0.0012), good);
}

TEST(DefectiveMesh, FlippedFacesAreTurned) {
  const TriangleMesh good = make_sphere(0.015);
  TriangleMesh mesh = good;
  std::mt19937 random(1);
  for (std::size_t i = 0; i < mesh.triangles.size() / 10; ++i) {
    turn(mesh, random() % mesh.triangles.size());
  }
  expect_like(field_of(mesh), good);
}

TEST(DefectiveMesh, InsideOutIsTurned) {
  const TriangleMesh good = make_box({0.04, 0.03, 0.02});
  expect_like(field_of(inside_out(good)), good);
}

TEST(DefectiveMesh, AFewMissingTrianglesDoNotMatter) {
  const TriangleMesh good = make_sphere(0.015);
  TriangleMesh mesh = good;
  for (const std::ptrdiff_t t : {400, 200, 7}) {
    mesh.triangles.erase(mesh.triangles.begin() + t);
  }
  const SignedDistanceField field = field_of(mesh, 0.002);
  EXPECT_LT(std::abs(volume_error(field, signed_volume(good))), 0.01);
  EXPECT_EQ(surface_errors(field, good).wrong_signs, 0.0);
}

TEST(DefectiveMesh, ManySmallHolesAreClosed) {
  // Too much in all to be left open: 2 % of the surface. No two of the holes meet.
  const TriangleMesh good = make_sphere(0.015);
  TriangleMesh mesh = good;
  std::vector<bool> at_hole(mesh.vertices.size(), false);
  const auto is_near_hole = [&](std::uint32_t vertex) { return at_hole[vertex]; };
  std::erase_if(mesh.triangles, [&, i = 0](const auto& triangle) mutable {
    if (i++ % 40 != 0 || std::any_of(triangle.begin(), triangle.end(), is_near_hole)) return false;
    for (const std::uint32_t vertex : triangle) at_hole[vertex] = true;
    return true;
  });
  ASSERT_LT(surface_area(mesh), 0.98 * surface_area(good));
  expect_like(field_of(mesh, 0.002), good);
}

TEST(DefectiveMesh, AMissingFaceIsRefused) {
  for (const Eigen::Vector3d& size :
       {Eigen::Vector3d(0.1, 0.1, 0.1), Eigen::Vector3d(0.95, 0.95, 0.018)}) {
    for (std::size_t face = 0; face < 12; face += 2) {
      TriangleMesh mesh = make_box(size);
      mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(face),
                           mesh.triangles.begin() + static_cast<std::ptrdiff_t>(face + 2));
      EXPECT_THAT(refusal(mesh), AllOf(HasSubstr("open"), HasSubstr("Fill Holes")))
          << size.transpose() << " " << face;
    }
  }
}

TEST(DefectiveMesh, ASheetIsRefused) {
  const TriangleMesh sheet{{{0, 0, 0}, {0.1, 0, 0}, {0.1, 0.1, 0}, {0, 0.1, 0}},
                           {{0, 1, 2}, {0, 2, 3}}};
  EXPECT_THAT(refusal(sheet),
              AllOf(HasSubstr("geometry: "), HasSubstr("100 %"), HasSubstr("Solidify")));
  TriangleMesh doubled = sheet;
  append(doubled, inside_out(sheet));
  EXPECT_THAT(refusal(doubled), HasSubstr("geometry: "));
}

TEST(DefectiveMesh, NothingAndNonsenseAreRefused) {
  EXPECT_THAT(refusal({}), HasSubstr("no triangle"));
  TriangleMesh mesh = make_box({0.1, 0.1, 0.1});
  mesh.triangles[3][1] = 99;
  EXPECT_THAT(refusal(mesh), HasSubstr("missing"));
  mesh = make_box({0.1, 0.1, 0.1});
  mesh.vertices[2].x() = std::nan("");
  EXPECT_THAT(refusal(mesh), HasSubstr("not finite"));
}

TEST(OverlappingSolids, AreOneSolid) {
  TriangleMesh mesh = make_box({0.04, 0.04, 0.02});
  append(mesh, moved(make_box({0.02, 0.02, 0.04}), 0.003, 0.002, 0.015));
  const double volume = 0.04 * 0.04 * 0.02 + 0.02 * 0.02 * (0.035 - 0.01);
  const SignedDistanceField field = field_of(mesh);
  EXPECT_NEAR(field.storage().mesh_volume, volume, 0.005 * volume);
  EXPECT_LT(std::abs(volume_error(field, volume)), 0.01);
  // In the middle of the overlap, on what were faces: the way out is to the union's surface.
  const auto distance = [&](float x, float y, float z) { return field.sample({x, y, z}).distance; };
  EXPECT_NEAR(distance(0.003F, 0.002F, 0.01F), -0.010F, 1.5e-3F);
  EXPECT_NEAR(distance(0.003F, 0.002F, -0.005F), -0.005F, 2e-4F);
}

TEST(OverlappingSolids, InFlushContactHaveNoFaceBetweenThem) {
  // A block on a board, the contact exactly coplanar.
  TriangleMesh mesh = make_box({0.2, 0.15, 0.01});
  append(mesh, moved(make_box({0.06, 0.06, 0.03}), 0.02, 0.01, 0.02));
  const double volume = 0.2 * 0.15 * 0.01 + 0.06 * 0.06 * 0.03;
  const SignedDistanceField field = field_of(mesh);
  EXPECT_NEAR(field.storage().mesh_volume, volume, 1e-3 * volume);
  EXPECT_LT(std::abs(volume_error(field, volume)), 0.01);
  EXPECT_NEAR(field.sample({0.02F, 0.01F, 0.005F}).distance, -0.01F, 1e-3F);
  EXPECT_NEAR(field.thickness(), 0.01, 1e-6);
}

TEST(OverlappingSolids, BoardsThatTouchHaveTheVolumeOfAllTogether) {
  // The thin side of one board on the wide face of another, flush at its end.
  const TriangleMesh side = make_box({0.012, 0.5, 0.72});
  const TriangleMesh top = make_box({0.6, 0.5, 0.012});
  TriangleMesh mesh = moved(side, -0.294, 0.0, 0.0);
  append(mesh, moved(top, 0.0, 0.0, 0.366));
  const double volume = signed_volume(side) + signed_volume(top);
  EXPECT_NEAR(field_of(mesh, 0.006).storage().mesh_volume, volume, 1e-9 * volume);
}

TEST(OverlappingSolids, EqualBoxesInARowHaveTheVolumeOfAllTogether) {
  TriangleMesh mesh;
  for (const double x : {0.0, 0.03, 0.06})
    append(mesh, moved(make_box({0.03, 0.03, 0.03}), x, 0, 0));
  const SignedDistanceField field = field_of(mesh);
  EXPECT_NEAR(field.storage().mesh_volume, 3 * 2.7e-5, 1e-12);
  EXPECT_NEAR(field.sample({0.015F, 0.0F, 0.0F}).distance, -0.015F, 1e-3F);
}

TEST(OverlappingSolids, ThatAreSunkIntoEachOtherALittleCountThatOnce) {
  // Boards as they are often drawn: 1 mm into each other, so that no gap can be; at a corner three.
  TriangleMesh mesh = make_box({0.018, 0.5, 0.32});
  append(mesh, moved(make_box({0.366, 0.018, 0.32}), 0.191, 0.241, 0.0));
  append(mesh, moved(make_box({0.366, 0.466, 0.01}), 0.191, 0.0, 0.155));
  const double shared = 0.001 * (0.018 * 0.32 + 0.466 * 0.01) + 0.001 * 0.366 * 0.01 - 1e-8;
  const double volume = signed_volume(mesh) - shared;
  EXPECT_NEAR(field_of(mesh, 0.005).storage().mesh_volume, volume, 1e-4 * volume);
}

TEST(OverlappingSolids, ThatAreTurnedCountTheirOverlapOnce) {
  const TriangleMesh bar = make_box({0.1, 0.02, 0.02});
  TriangleMesh mesh = bar;
  append(mesh, transformed(bar, Eigen::Isometry3d(Eigen::AngleAxisd(std::numbers::pi / 4,
                                                                    Eigen::Vector3d::UnitZ()))));
  const double shared = 0.02 * 0.02 * std::sqrt(2.0) * 0.02;  // a rhombus
  const double volume = 2 * signed_volume(bar) - shared;
  EXPECT_NEAR(field_of(mesh).storage().mesh_volume, volume, 2e-3 * volume);
}

TEST(OverlappingSolids, WithCoplanarSidesCountTheOverlapOnce) {
  // A bar with a thicker end, sunk into it by 1 mm, flush on three sides.
  TriangleMesh mesh = make_box({0.2, 0.03, 0.02});
  append(mesh, moved(make_box({0.05, 0.03, 0.016}), -0.075, 0.0, 0.017));
  const double volume = 0.2 * 0.03 * 0.02 + 0.05 * 0.03 * 0.015;
  const SignedDistanceField field = field_of(mesh);
  EXPECT_NEAR(field.storage().mesh_volume, volume, 1e-3 * volume);
  EXPECT_LT(std::abs(volume_error(field, volume)), 0.01);
  EXPECT_GT(field.voxel(), 0.001);
}

TEST(OverlappingSolids, OneWithinAnotherAddsNothing) {
  const TriangleMesh good = make_box({0.04, 0.03, 0.03});
  TriangleMesh mesh = good;
  append(mesh, make_box({0.01, 0.01, 0.01}));
  append(mesh, good);  // the same body twice
  const SignedDistanceField field = field_of(mesh);
  expect_like(field, good);
  EXPECT_NEAR(field.sample(Eigen::Vector3f::Zero()).distance, -0.015F, 1e-3F);
}

TEST(OverlappingSolids, ACavityStaysHollow) {
  TriangleMesh mesh = make_box({0.05, 0.05, 0.05});
  append(mesh, inside_out(make_box({0.03, 0.03, 0.03})));
  const SignedDistanceField field = field_of(mesh);
  EXPECT_NEAR(field.sample(Eigen::Vector3f::Zero()).distance, 0.015F, 1e-3F);
  EXPECT_NEAR(field.sample({0.02F, 0.0F, 0.0F}).distance, -0.005F, 2e-4F);
  EXPECT_NEAR(field.thickness(), 0.01, 1e-6);
  EXPECT_LT(std::abs(volume_error(field, 0.000125 - 0.000027)), 0.01);
}

}  // namespace
}  // namespace lockbox
