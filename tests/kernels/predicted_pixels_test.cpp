// SPDX-License-Identifier: BSD-3-Clause
// What the pixels of points are predicted to show decides which surface they were measured on.
#include <gtest/gtest.h>

#include "seen_sphere.hpp"

namespace lockbox::kernels {
namespace {

using PredictedPixelsTest = SeenSphere;

/// Points 2 mm inside the back of the sphere, whose pixels show its front.
class FrontPredicted : public SeenSphere {
 protected:
  static constexpr float kFront = 0.44F;
  static constexpr float kMeasured = 0.558F;

  FrontPredicted() {
    noise.depth_floor = 0.05F;
    x.fill(0.0F);
    y.fill(0.0F);
    z.fill(kMeasured);
    predicted_body.fill(kBody);
    predicted_depth.fill(kFront);
    plane_offset.fill(kNoPlane);
  }
};

TEST_F(FrontPredicted, ThePlaneThatTheRayMeetsWinsOverAFarSide) {
  look_up_all();
  EXPECT_NEAR(nearest[0], -0.002F, 1e-3F);
  EXPECT_NEAR(distance[0], kFront - kMeasured, 1e-3F);
  EXPECT_NEAR(normal[2][0], -1.0F, 1e-2F);
  EXPECT_NEAR(inverse_variance[0] * 0.0506F * 0.0506F, 1.0F, 0.05F);
  EXPECT_LT(plane_offset[0], kNoPlane);
}

TEST_F(FrontPredicted, ItDoesSoForPointsOffTheField) {
  noise.depth_floor = 0.1F;
  z[0] = 0.75F;
  look_up_all();
  EXPECT_EQ(nearest[0], kPadding);
  EXPECT_NEAR(distance[0], kFront - 0.75F, 2e-3F);
  EXPECT_GT(inverse_variance[0], 0.0F);
}

TEST_F(FrontPredicted, FrozenPlanesMoveWithTheirBody) {
  look_up_all();
  const float before = distance[0];
  motion.translation[2] += 0.01F;  // the body comes nearer
  frozen_distance(motion, points(), {predicted_body.data(), predicted_depth.data()}, kBody,
                  planes(), nearest.data(), distance.data());
  EXPECT_NEAR(distance[0], before + 0.01F * normal[2][0], 1e-5F);
}

TEST_F(FrontPredicted, OfOtherBodiesOrBeyondTheCutNothingCompetes) {
  predicted_body[0] = kBody + 1.0F;
  predicted_depth[1] = kMeasured - 1.1F * kGate * noise.depth_floor;
  look_up_all();
  for (const std::size_t i : {0U, 1U}) {
    EXPECT_EQ(distance[i], nearest[i]);
    EXPECT_EQ(inverse_variance[i], 0.0F);
    EXPECT_EQ(plane_offset[i], kNoPlane);
  }
}

TEST_F(PredictedPixelsTest, WhereTheRayMeetsTheNearestSurfaceNothingChanges) {
  for (std::size_t i = 0; i + 1 < kPoints; ++i) {
    x[i] *= 0.1F;  // where the sphere is nearly flat
    y[i] *= 0.1F;
    z[i] = 0.44F + 0.1F * (z[i] - 0.5F);
  }
  look_up_all();
  const Array alone = distance;
  predicted_body.fill(kBody);
  predicted_depth.fill(0.44F);
  look_up_all();
  for (std::size_t i = 0; i + 1 < kPoints; ++i) EXPECT_NEAR(distance[i], alone[i], 5e-4F);
}

/// Points 2 mm before the sphere's front.
class SomethingBefore : public SeenSphere {
 protected:
  static constexpr float kBefore = 0.438F;
  static constexpr float kFarBehind = 0.5F;  // of its inside, say

  SomethingBefore() {
    x.fill(0.0F);
    y.fill(0.0F);
    z.fill(kBefore);
    predicted_body.fill(kBody);
    predicted_depth.fill(kFarBehind);
  }
};

TEST_F(SomethingBefore, WhatThePixelShowsOfTheBodyExplainsNothing) {
  predicted_depth[1] = kBefore - (kFarBehind - kBefore);  // as far before the point
  predicted_body[2] = kBody + 1.0F;
  look_up_all();
  EXPECT_EQ(inverse_variance[0], 0.0F);
  EXPECT_GT(inverse_variance[1], 0.0F);
  EXPECT_GT(inverse_variance[2], 0.0F);
}

TEST_F(SomethingBefore, WhatMayBeAsFarOffStillExplains) {
  noise.annealing_sigma = 1.1F * (kFarBehind - kBefore) / kGate;
  look_up_all();
  EXPECT_GT(inverse_variance[0], 0.0F);
}

TEST_F(SomethingBefore, TheEdgeOfAGrooveStillExplains) {
  predicted_depth.fill(kBefore + 0.03F);
  look_up_all();
  EXPECT_GT(inverse_variance[0], 0.0F);
}

}  // namespace
}  // namespace lockbox::kernels
