// SPDX-License-Identifier: BSD-3-Clause
// Property "volumes are right": each link's field agrees with its mesh (volume within 1 %, surface
// within a tenth of a voxel, signs right) wherever the body lies on the grid; a mesh that bounds
// nothing is refused by name (tests/sdf/defective_mesh_test.cpp: what is repaired).
#include <gtest/gtest.h>

#include <array>

#include "initialization/seen_model.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/mesh/primitives.hpp"
#include "registration/mechanism.hpp"
#include "sdf/field_fixture.hpp"

namespace lockbox {
namespace {

void expect_faithful(const SignedDistanceField& field, const TriangleMesh& mesh) {
  const SurfaceErrors errors = surface_errors(field, mesh);
  EXPECT_LT(std::abs(volume_error(field, signed_volume(mesh))), 0.01);
  EXPECT_NEAR(field.storage().mesh_volume, signed_volume(mesh), 1e-9 * signed_volume(mesh));
  EXPECT_LT(errors.mean_distance, 0.1);
  EXPECT_EQ(errors.wrong_signs, 0.0);
  EXPECT_LE(field.voxel(), 0.5 * field.thickness());
}

class FieldAtRandomPlacements : public testing::TestWithParam<int> {};

TEST_P(FieldAtRandomPlacements, IsFaithful) {
  const std::array<TriangleMesh, 3> shapes = {make_box({0.03, 0.02, 0.012}),
                                              make_cylinder(0.008, 0.03), make_sphere(0.01)};
  std::mt19937 random(static_cast<unsigned>(GetParam()));
  const TriangleMesh& shape = shapes[static_cast<std::size_t>(GetParam()) % shapes.size()];
  const TriangleMesh mesh = transformed(shape, random_placement(random));
  expect_faithful(field_of(mesh), mesh);
}

INSTANTIATE_TEST_SUITE_P(Hundred, FieldAtRandomPlacements, testing::Range(0, 100));

TEST(FieldOnGridPlanes, BoxesAreSolid) {
  // All sizes are whole numbers of blocks, so that with some offset every face meets samples.
  for (const double voxel : {0.001, 0.002, 0.0025}) {
    for (const int blocks : {1, 2, 3}) {
      const double edge = 8.0 * voxel * blocks;
      const TriangleMesh mesh = moved(make_box({edge, edge, 2.0 * edge}), edge, -edge, 0.5 * edge);
      const SignedDistanceField field = field_of(mesh, voxel);
      EXPECT_LT(surface_errors(field, mesh).mean_distance, 0.1);
      EXPECT_EQ(surface_errors(field, mesh).wrong_signs, 0.0);
      const double rounded_edges = 0.5 * voxel * voxel * 16.0 * edge;
      EXPECT_NEAR(field.enclosed_volume(), signed_volume(mesh), rounded_edges);
      EXPECT_NEAR(static_cast<double>(field
                                          .sample(Eigen::Vector3f(static_cast<float>(edge),
                                                                  static_cast<float>(-edge),
                                                                  static_cast<float>(0.5 * edge)))
                                          .distance),
                  -0.5 * edge, 0.02 * edge + voxel);
    }
  }
}

TEST(FieldOfPlates, EighteenMillimetresAtFiveMillimetreVoxels) {
  std::mt19937 random(7);
  for (int i = 0; i < 3; ++i) {
    const TriangleMesh mesh = transformed(make_box({0.25, 0.2, 0.018}), random_placement(random));
    const SignedDistanceField field = field_of(mesh, 0.005);
    EXPECT_NEAR(field.thickness(), 0.018, 1e-6);
    EXPECT_LT(std::abs(volume_error(field, signed_volume(mesh))), 0.02);
    EXPECT_LT(surface_errors(field, mesh).mean_distance, 0.1);
    EXPECT_EQ(surface_errors(field, mesh).wrong_signs, 0.0);
  }
}

TEST(FieldOfPlates, ThreeMillimetresAtTheChosenVoxel) {
  const TriangleMesh mesh = make_box({0.04, 0.03, 0.003});
  expect_faithful(field_of(mesh), mesh);
}

TEST(FieldDistances, AreExactOffTheSurface) {
  const Eigen::Vector3d half(0.05, 0.03, 0.02);
  const SignedDistanceField field = field_of(make_box(2.0 * half), 0.002);
  std::mt19937 random(8);
  std::uniform_real_distribution<double> uniform(-0.015, 0.015);
  for (int i = 0; i < 2000; ++i) {
    // Beside the faces, where the distance is linear and interpolation adds nothing.
    const Eigen::Vector3d p(uniform(random), uniform(random), half.z() + uniform(random));
    const DistanceSample sample = field.sample(p.cast<float>());
    if (p.z() - half.z() > -0.005) {
      EXPECT_NEAR(static_cast<double>(sample.distance), p.z() - half.z(), 2e-5);
      EXPECT_TRUE(sample.gradient.isApprox(Eigen::Vector3f::UnitZ(), 0.02F));
    }
  }
}

class FieldsOfShippedModels : public testing::TestWithParam<const char*> {};

TEST_P(FieldsOfShippedModels, EncloseTheirLinks) {
  const ArticulatedModel& model = shipped(GetParam());
  for (std::size_t b = 0; b < model.fields.size(); ++b) {
    SCOPED_TRACE(model.tree.bodies[b].name);
    const SignedDistanceField& field = *model.fields[b];
    EXPECT_LT(std::abs(volume_error(field, field.storage().mesh_volume)), 0.01);
    EXPECT_LE(field.voxel(), 0.5 * field.thickness());
    double distance = 0.0;
    double area = 0.0;
    for (const SurfaceSample& sample : sample_surface(model.tree.bodies[b].mesh, 0.004)) {
      const double d = field.sample(sample.position.cast<float>()).distance;
      if (d > -0.5 * field.voxel()) {  // else buried in another solid of the same link
        distance += std::abs(d) * sample.area;
        area += sample.area;
      }
    }
    EXPECT_LT(distance, 0.1 * field.voxel() * area);
    EXPECT_GT(area, 0.5 * surface_area(model.tree.bodies[b].mesh));
  }
}

INSTANTIATE_TEST_SUITE_P(Links, FieldsOfShippedModels,
                         testing::Values("lockbox", "lockbox_overlapping", "cabinet", "rigid_block",
                                         "board_door_block"),
                         [](const auto& model) { return std::string(model.param); });

TEST(OpenMesh, IsRefusedByTheNameOfItsLink) {
  try {
    load_mechanism({R"(<link name="good"><visual><geometry><box size="0.1 0.1 0.1"/></geometry>
                       </visual></link>)",
                    R"(<link name="sheet"><visual><geometry><box size="0.1 0.1 0"/></geometry>
                       </visual></link>)",
                    R"(<joint name="slide" type="prismatic"><parent link="good"/>
                       <child link="sheet"/><axis xyz="1 0 0"/>
                       <limit lower="0" upper="0.1" effort="1" velocity="1"/></joint>)"},
                   with_cache());
    FAIL() << "accepted a sheet as a solid";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("'sheet'"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace lockbox
