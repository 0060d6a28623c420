// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/visualization/model_distance.hpp"

#include <gtest/gtest.h>

#include "block_model.hpp"

namespace lockbox {
namespace {

constexpr float kLimit = 0.01F;

/// Of one point, to the block whose front face is at z = 0.95 m.
float distance_to_block(const Eigen::Vector3f& p_camera) {
  static const ArticulatedModel model = block_model();
  std::vector<float> distances;
  model_distances(model, {one_metre_away().T_camera_base}, {p_camera}, kLimit, distances);
  return distances.at(0);
}

TEST(ModelDistance, IsPositiveBeforeTheSurfaceAndNegativeBehindIt) {
  EXPECT_NEAR(distance_to_block({0.02F, 0.01F, 0.945F}), 0.005F, 2e-4F);
  EXPECT_NEAR(distance_to_block({0.02F, 0.01F, 0.957F}), -0.007F, 2e-4F);
  EXPECT_NEAR(distance_to_block({-0.106F, 0.0F, 1.0F}), 0.006F, 2e-4F);
}

TEST(ModelDistance, IsInfiniteBeyondTheLimitButKnownDeepInside) {
  EXPECT_EQ(distance_to_block({0.0F, 0.0F, 0.9F}), kFarFromModel);
  EXPECT_EQ(distance_to_block({3.0F, 0.0F, 1.0F}), kFarFromModel);
  EXPECT_LT(distance_to_block({0.0F, 0.0F, 0.99F}), -0.03F);
}

TEST(ModelDistance, IsThatToTheNearestBody) {
  ArticulatedModel model = block_model();
  model.tree.bodies.push_back(model.tree.bodies[0]);
  model.fields.push_back(std::nullopt);  // a frame without geometry
  auto second = block_model();
  model.tree.bodies.push_back(second.tree.bodies[0]);
  model.fields.push_back(std::move(second.fields[0]));
  // The blocks leave a gap of 8 mm between x = 0.1 and x = 0.108.
  const Eigen::Isometry3d first(Eigen::Translation3d(0.0, 0.0, 1.0));
  const Eigen::Isometry3d third(Eigen::Translation3d(0.208, 0.0, 1.0));
  std::vector<float> distances;
  model_distances(model, {first, first, third}, {{0.102F, 0.0F, 1.0F}, {0.107F, 0.0F, 1.0F}},
                  kLimit, distances);
  EXPECT_NEAR(distances[0], 0.002F, 2e-4F);
  EXPECT_NEAR(distances[1], 0.001F, 2e-4F);
}

TEST(DistanceColor, IsRedBehindWhiteOnAndBlueBeforeTheSurface) {
  const auto behind = distance_color(-kLimit, kLimit);
  const auto on = distance_color(0.0F, kLimit);
  const auto before = distance_color(kLimit, kLimit);
  EXPECT_GT(behind.x(), 3.0F * behind.z());
  EXPECT_GT(before.z(), 3.0F * before.x());
  EXPECT_GT(on.minCoeff(), 0.9F);
  EXPECT_EQ(distance_color(-2.0F * kLimit, kLimit), behind);
}

TEST(DistanceScale, RunsFromMinusToPlusTheLimitInMillimetres) {
  const auto scale = distance_scale(kLimit);
  EXPECT_NEAR(scale.front().value, -10.0, 1e-5);
  EXPECT_NEAR(scale.back().value, 10.0, 1e-5);
  EXPECT_EQ(scale[scale.size() / 2].color, distance_color(0.0F, kLimit));
}

}  // namespace
}  // namespace lockbox
