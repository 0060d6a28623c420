// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "field_fixture.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/mesh/primitives.hpp"

namespace lockbox {
namespace {

std::string refusal(const TriangleMesh& mesh, const FieldOptions& options) {
  try {
    build_field(mesh, options, Executor(1));
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

FieldOptions with_voxel(double voxel) {
  FieldOptions options;
  options.voxel = voxel;
  options.far_reach = 0.05;
  return options;
}

TEST(FieldVoxel, FollowsTheThinnestWall) {
  EXPECT_NEAR(field_of(make_box({0.3, 0.3, 0.012})).voxel(), 0.003, 1e-6);
  EXPECT_NEAR(field_of(make_box({0.12, 0.12, 0.1})).voxel(), 0.004, 1e-6);
}

TEST(FieldVoxel, FollowsAThinPartOfAThickBody) {
  TriangleMesh mesh = make_box({0.1, 0.1, 0.03});
  append(mesh, moved(make_box({0.004, 0.03, 0.03}), 0.0, 0.0, 0.025));
  const SignedDistanceField field = field_of(mesh);
  EXPECT_NEAR(field.thickness(), 0.004, 1e-6);
  EXPECT_LE(field.voxel(), 0.002);
}

TEST(FieldVoxel, IsCoarsenedToKeepTheBudgetButNotBeyondHalfTheWall) {
  FieldOptions options = with_voxel(0.0);
  options.memory_budget = 4e5;
  const SignedDistanceField field =
      build_field(make_box({0.15, 0.15, 0.012}), options, Executor(1));
  EXPECT_GT(field.voxel(), 0.003);
  EXPECT_LE(field.voxel(), 0.006 + 1e-7);
}

TEST(FieldVoxel, BeyondHalfTheWallIsRefused) {
  const TriangleMesh plate = make_box({0.1, 0.1, 0.008});
  EXPECT_THAT(
      refusal(plate, with_voxel(0.005)),
      testing::AllOf(testing::HasSubstr("half the thinnest wall"), testing::HasSubstr("4 mm")));
  EXPECT_EQ(refusal(plate, with_voxel(0.004)), "accepted");
}

/// The number between two texts of a message.
double number_between(const std::string& message, const std::string& before,
                      const std::string& after) {
  const std::size_t begin = message.find(before) + before.size();
  return std::stod(message.substr(begin, message.find(after, begin) - begin));
}

TEST(FieldVoxel, ThatWouldFillTheMemoryIsRefusedWithOneThatDoesNot) {
  const TriangleMesh box = make_box({1.0, 1.0, 1.0});
  const std::string message = refusal(box, with_voxel(1e-6));
  EXPECT_THAT(message, testing::HasSubstr("a voxel of 1 um would take more than the limit of 512"));
  const double least = 1e-3 * number_between(message, "choose a voxel of ", " mm");
  EXPECT_GT(least, 2e-4);
  EXPECT_LT(least, 2e-3);
}

TEST(FieldVoxel, ThatIsAdvisedIsAccepted) {
  const TriangleMesh box = make_box({0.1, 0.1, 0.1});
  FieldOptions options = with_voxel(2e-4);
  options.memory_limit = 1e6;
  const std::string message = refusal(box, options);
  options.voxel = 1e-3 * number_between(message, "choose a voxel of ", " mm");
  EXPECT_GT(options.voxel, 2e-4);
  EXPECT_EQ(refusal(box, options), "accepted") << message;
}

TEST(FieldVoxel, OfWallsTooThinForTheMemoryIsAnsweredWithTheThicknessThatIsNot) {
  FieldOptions options;
  options.far_reach = 0.05;
  options.memory_budget = 1e5;
  options.memory_limit = 1e6;
  const std::string message = refusal(make_box({0.3, 0.2, 2e-4}), options);
  EXPECT_THAT(message, testing::HasSubstr("walls of 200 um allow none that is coarser"));
  EXPECT_THAT(message, testing::Not(testing::HasSubstr("choose")));
  const double advised = 1e-3 * number_between(message, "thicken them to ", " mm");
  EXPECT_EQ(refusal(make_box({0.3, 0.2, advised}), options), "accepted") << message;
}

TEST(FieldVoxel, OfASmallSurfaceThatReachesFarIsCoarsened) {
  TriangleMesh mesh = make_box({0.02, 0.02, 0.02});
  append(mesh, moved(make_box({0.02, 0.02, 0.02}), 6.0, 6.0, 6.0));
  const SignedDistanceField field = build_field(mesh, with_voxel(0.0), Executor(1));
  EXPECT_LT(field.memory_bytes(), 512e6);
  EXPECT_LE(field.voxel(), 0.01);
}

TEST(FieldVoxel, TakesNoMemoryForTheSpaceAroundANeedle) {
  const Eigen::Isometry3d turned(Eigen::AngleAxisd(0.9, Eigen::Vector3d(1, 2, 3).normalized()));
  const TriangleMesh needle = transformed(make_box({20.0, 0.002, 0.002}), turned);
  EXPECT_THAT(refusal(needle, with_voxel(0.0)), testing::HasSubstr("512"));
}

TEST(FieldVoxel, OfABodyWithAVertexFarOffIsRefusedByItsBox) {
  TriangleMesh mesh = make_sphere(0.1);
  mesh.vertices[mesh.vertices.size() / 2] = {1000.0, 0.0, 0.0};
  EXPECT_THAT(refusal(mesh, FieldOptions{}),
              testing::AllOf(testing::HasSubstr("1000 m large"), testing::HasSubstr("far off")));
}

TEST(FieldVoxel, OfABodySmallerThanADustGrainIsFound) {
  const SignedDistanceField field =
      build_field(make_box({2e-7, 1.2e-7, 5e-8}), with_voxel(0.0), Executor(1));
  EXPECT_LE(field.voxel(), 2.6e-8);
}

TEST(FieldOptions, WithoutMeaningAreRefused) {
  const TriangleMesh box = make_box({0.1, 0.1, 0.1});
  EXPECT_THAT(refusal(box, with_voxel(-0.001)), testing::HasSubstr("field options"));
  EXPECT_THAT(refusal(box, with_voxel(std::nan(""))), testing::HasSubstr("field options"));
  FieldOptions options;
  options.far_reach = std::numeric_limits<double>::infinity();
  EXPECT_THAT(refusal(box, options), testing::HasSubstr("field options"));
}

TEST(FieldBand, IsFineOnBothSides) {
  const SignedDistanceField field = field_of(make_box({0.1, 0.1, 0.1}), 0.004);
  for (const float offset : {-0.0199F, -0.01F, 0.01F, 0.0199F}) {
    const Eigen::Vector3f p(0.05F + offset, 0.011F, -0.007F);
    EXPECT_NEAR(field.sample(p).distance, offset, 2e-5F);
  }
}

TEST(FieldReach, CarriesDistanceToTheWidestGate) {
  FieldOptions options;
  const SignedDistanceField field = build_field(make_box({0.1, 0.1, 0.1}), options, Executor(1));
  EXPECT_NEAR(field.sample({0.549F, 0.0F, 0.0F}).distance, 0.499F, 2e-3F);
  EXPECT_LT(field.memory_bytes(), 1500000U);
}

}  // namespace
}  // namespace lockbox
