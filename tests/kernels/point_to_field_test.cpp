// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/kernels/point_to_field.hpp"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cmath>
#include <vector>

#include "seen_sphere.hpp"

namespace lockbox::kernels {
namespace {

using PointToFieldTest = SeenSphere;

TEST_F(PointToFieldTest, DistanceAndGradientAreThoseOfTheSphere) {
  look_up_all();
  for (std::size_t i = 0; i + 1 < kPoints; ++i) {
    const float radius = std::hypot(x[i], y[i], z[i] - 0.5F);
    if (radius < 0.03F) {
      continue;  // near the centre no grid resolves the sphere's field
    }
    // A coarse cell bends the sphere by at most voxel^2 / (8 radius) along each of two axes.
    EXPECT_NEAR(distance[i], radius - SphereField::kRadius,
                2 * 0.02F * 0.02F / (8 * radius) + 2e-5F);
    EXPECT_NEAR(position[2][i], z[i] - 0.5F, 1e-6F);
  }
}

TEST_F(PointToFieldTest, GradientIsTheDerivativeOfTheInterpolant) {
  look_up_all();
  constexpr float kStep = 2e-5F;
  int compared = 0;
  for (int axis = 0; axis < 3; ++axis) {
    Array plus, minus;
    Array* moved = axis == 0 ? &x : axis == 1 ? &y : &z;
    for (float& c : *moved) c += kStep;
    look_up_distance(field.view, motion, points(), plus.data());
    for (float& c : *moved) c -= 2 * kStep;
    look_up_distance(field.view, motion, points(), minus.data());
    for (float& c : *moved) c += kStep;
    for (std::size_t i = 0; i + 1 < kPoints; ++i) {
      const float numeric = (plus[i] - minus[i]) / (2 * kStep);
      // Across a cell's border the interpolant has a kink: there one-sided slopes differ.
      const float g = (position[static_cast<std::size_t>(axis)][i] + 0.08F) / 0.005F;
      if (std::abs(g - std::round(g)) > 0.02F) {
        EXPECT_NEAR(numeric, normal[static_cast<std::size_t>(axis)][i], 5e-3F) << i;
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 600);
}

TEST_F(PointToFieldTest, VarianceIsThatOfThePointAlongTheGradient) {
  look_up_all();
  for (std::size_t i = 0; i + 1 < kPoints; ++i) {
    if (inverse_variance[i] == 0.0F) {
      continue;
    }
    const float ray[3] = {x[i] / z[i], y[i] / z[i], 1.0F};
    const float ray2 = ray[0] * ray[0] + ray[1] * ray[1] + 1.0F;
    float along = 0.0F, norm2 = 0.0F;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      along += normal[axis][i] * ray[axis];
      norm2 += normal[axis][i] * normal[axis][i];
    }
    const float sigma_z = noise.depth_floor + noise.depth_quadratic * z[i] * z[i];
    const float lateral = noise.lateral * z[i];
    const float variance =
        along * along * sigma_z * sigma_z + (norm2 - along * along / ray2) * lateral * lateral;
    EXPECT_NEAR(inverse_variance[i] * variance, 1.0F, 1e-3F);
  }
}

TEST_F(PointToFieldTest, FarSideOfTheBodyExplainsNothing) {
  x.fill(0.0F);
  y.fill(0.0F);
  z.fill(0.5F + 0.058F);  // 2 mm inside the back of the sphere
  z[0] = 0.5F - 0.058F;   // 2 mm inside its front
  look_up_all();
  EXPECT_GT(inverse_variance[0], 0.0F);
  EXPECT_EQ(inverse_variance[1], 0.0F);
}

TEST_F(PointToFieldTest, PointsOffTheFieldAndPaddingExplainNothing) {
  x[3] = 0.5F;
  look_up_all();
  EXPECT_EQ(inverse_variance[3], 0.0F);
  EXPECT_EQ(inverse_variance[kPoints - 1], 0.0F);
}

TEST_F(PointToFieldTest, SumsAreThoseOfAPlainLoop) {
  look_up_all();
  for (std::size_t i = 0; i < kPoints; ++i) {
    weight[i] = inverse_variance[i] * 0.25F;
  }
  const NormalSums sums = accumulate(kPoints, hits(), weight.data());
  double hessian[21] = {}, gradient[6] = {}, squares = 0.0;
  double mass = 0.0, first[3] = {}, second[6] = {};
  for (std::size_t i = 0; i < kPoints; ++i) {
    if (weight[i] == 0.0F) continue;
    const double n[3] = {normal[0][i], normal[1][i], normal[2][i]};
    const double p[3] = {position[0][i], position[1][i], position[2][i]};
    const double a[6] = {-n[0],
                         -n[1],
                         -n[2],
                         -(p[1] * n[2] - p[2] * n[1]),
                         -(p[2] * n[0] - p[0] * n[2]),
                         -(p[0] * n[1] - p[1] * n[0])};
    const double w = weight[i], d = distance[i];
    int k = 0;
    for (int r = 0; r < 6; ++r) {
      for (int c = r; c < 6; ++c) hessian[k++] += w * a[r] * a[c];
      gradient[r] += w * d * a[r];
    }
    squares += w * d * d;
    mass += w;
    k = 0;
    for (int r = 0; r < 3; ++r) {
      first[r] += w * p[r];
      for (int c = r; c < 3; ++c) second[k++] += w * p[r] * p[c];
    }
  }
  const double scale = std::abs(hessian[0]) + std::abs(hessian[6]);
  for (int k = 0; k < 21; ++k) EXPECT_NEAR(sums.hessian[k], hessian[k], 1e-5 * scale);
  for (int k = 0; k < 6; ++k) EXPECT_NEAR(sums.gradient[k], gradient[k], 1e-6 * scale);
  EXPECT_NEAR(sums.weighted_squares / squares, 1.0, 1e-4);
  EXPECT_NEAR(sums.mass / mass, 1.0, 1e-5);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(sums.first_moment[k], first[k], 1e-5 * mass);
  for (int k = 0; k < 6; ++k) EXPECT_NEAR(sums.second_moment[k], second[k], 1e-5 * mass);
}

TEST_F(PointToFieldTest, EveryInstructionSetOfTheMachineAgrees) {
  std::vector<float> first;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    look_up_all();
    std::vector<float> result(distance.begin(), distance.end() - 1);
    result.insert(result.end(), normal[1].begin(), normal[1].end() - 1);
    if (first.empty()) {
      first = result;
    }
    for (std::size_t i = 0; i < result.size(); ++i) {
      EXPECT_NEAR(result[i], first[i], 2e-6F * std::max(1.0F, std::abs(first[i])))
          << hwy::TargetName(target);
    }
  }
  hwy::SetSupportedTargetsForTest(0);
}

}  // namespace
}  // namespace lockbox::kernels
