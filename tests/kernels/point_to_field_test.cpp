// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/kernels/point_to_field.hpp"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace lockbox::kernels {
namespace {

/// A sphere of 60 mm, sampled coarsely everywhere and finely in some blocks.
struct SphereField {
  static constexpr float kRadius = 0.06F;
  static constexpr float kUnit = 1e-5F;

  SphereField() {
    view.coarse_voxel = 0.02F;
    view.fine_voxel = 0.005F;
    view.coarse_scale = view.fine_scale = kUnit;
    for (int axis = 0; axis < 3; ++axis) {
      view.coarse_origin[axis] = -0.2F;
      view.coarse_size[axis] = 21;
      view.fine_origin[axis] = -0.08F;
      view.blocks[axis] = 4;
    }
    append_grid(view.coarse_origin, view.coarse_voxel, 21);
    block_first.assign(64, -1);
    for (int b = 0; b < 64; ++b) {
      if (b % 5 == 4) {
        continue;  // a hole, where the coarse grid must take over
      }
      const std::array<int, 3> index{b % 4, b / 4 % 4, b / 16};
      float origin[3];
      for (int axis = 0; axis < 3; ++axis) {
        origin[axis] = view.fine_origin[axis] +
                       static_cast<float>(index[static_cast<std::size_t>(axis)] * kBlockCells) *
                           view.fine_voxel;
      }
      block_first[static_cast<std::size_t>(b)] = static_cast<std::int32_t>(samples.size());
      append_grid(origin, view.fine_voxel, kBlockSamples);
    }
    samples.push_back(0);
    view.samples = samples.data();
    view.block_first = block_first.data();
  }

  void append_grid(const float* origin, float voxel, int size) {
    for (int k = 0; k < size; ++k) {
      for (int j = 0; j < size; ++j) {
        for (int i = 0; i < size; ++i) {
          const float d = std::hypot(origin[0] + static_cast<float>(i) * voxel,
                                     origin[1] + static_cast<float>(j) * voxel,
                                     origin[2] + static_cast<float>(k) * voxel) -
                          kRadius;
          samples.push_back(static_cast<std::int16_t>(std::lround(d / kUnit)));
        }
      }
    }
  }

  FieldView view;
  std::vector<std::int16_t> samples;
  std::vector<std::int32_t> block_first;
};

/// A sphere half a metre in front of the camera, seen by a tile of points around it.
class PointToFieldTest : public ::testing::Test {
 protected:
  static constexpr std::size_t kPoints = 256;

  PointToFieldTest() {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> around(-0.1F, 0.1F);
    for (std::size_t i = 0; i < kPoints; ++i) {
      x[i] = around(random);
      y[i] = around(random);
      z[i] = 0.5F + around(random);
    }
    x[kPoints - 1] = y[kPoints - 1] = z[kPoints - 1] = kPadding;
  }

  void look_up_all() {
    look_up(field.view, motion, noise, points(), {predicted_body.data(), predicted_depth.data()},
            kBody, kCut, hits(), planes());
  }
  PointSpan points() { return {x.data(), y.data(), z.data(), kPoints}; }
  FieldHits hits() {
    return {distance.data(),
            nearest.data(),
            {normal[0].data(), normal[1].data(), normal[2].data()},
            {position[0].data(), position[1].data(), position[2].data()},
            inverse_variance.data()};
  }

  using Array = std::array<float, kPoints>;
  static constexpr float kBody = 3.0F;
  static constexpr float kCut = 4.0F;
  Array predicted_body{};  ///< another body, unless a test says otherwise
  Array predicted_depth{};
  SphereField field;
  RigidMotion motion{{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, -0.5F}};
  PointNoise noise{0.0005F, 0.002F, 0.001F, 0.0F};
  BodyPlanes planes() {
    return {plane_offset.data(),
            {plane_normal[0].data(), plane_normal[1].data(), plane_normal[2].data()}};
  }

  Array x, y, z, distance, nearest, inverse_variance, weight, plane_offset;
  std::array<Array, 3> plane_normal;
  std::array<Array, 3> normal, position;
};

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

/// Points 2 mm inside the back of the sphere, whose pixels show its front.
class FrontPredicted : public PointToFieldTest {
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
  predicted_depth[1] = kMeasured - 1.1F * kCut * noise.depth_floor;
  look_up_all();
  for (const std::size_t i : {0U, 1U}) {
    EXPECT_EQ(distance[i], nearest[i]);
    EXPECT_EQ(inverse_variance[i], 0.0F);
    EXPECT_EQ(plane_offset[i], kNoPlane);
  }
}

TEST_F(PointToFieldTest, WhereTheRayMeetsTheNearestSurfaceNothingChanges) {
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

TEST_F(PointToFieldTest, PointsOffTheFieldAndPaddingExplainNothing) {
  x[3] = 0.5F;
  look_up_all();
  EXPECT_EQ(inverse_variance[3], 0.0F);
  EXPECT_EQ(inverse_variance[kPoints - 1], 0.0F);
}

/// Association of one point at hand-made distances from bodies, with unit variance.
struct Association {
  explicit Association(const std::vector<float>& distances, float visible_body = -1.0F)
      : visible(kLanes, visible_body) {
    for (const float d : distances) {
      body.push_back(static_cast<float>(body.size()));
      distance.emplace_back(kLanes, kPadding).front() = d;
      inverse_variance.emplace_back(kLanes, 1.0F);
      weight.emplace_back(kLanes, -1.0F);
    }
  }
  double run() {
    std::vector<const float*> d, iv;
    std::vector<float*> w;
    for (std::size_t l = 0; l < distance.size(); ++l) {
      d.push_back(distance[l].data());
      iv.push_back(inverse_variance[l].data());
      w.push_back(weight[l].data());
    }
    const Candidates candidates{kLanes, d, iv, body, visible.data(), reach, kCut, kOdds};
    const double cost = associate(candidates, w);
    EXPECT_NEAR(cost, association_cost(candidates), 1e-4);
    return cost;
  }

  static constexpr float kCut = 4.0F;
  static constexpr float kOdds = 20.0F;
  float reach = 0.0F;
  std::vector<float> body, visible;
  std::vector<std::vector<float>> distance, inverse_variance, weight;
};

constexpr double kOutlierCost = 0.5 * Association::kCut * Association::kCut;

TEST(AssociationTest, LoneBodyIsQuadraticWithinTheCutAndConstantBeyond) {
  for (const float d : {0.0F, 0.5F, 2.0F, 3.9F, 4.1F, 100.0F}) {
    Association one({d});
    const double gaussian = std::exp(-0.5 * static_cast<double>(d * d));
    const double expected = -std::log(std::exp(-kOutlierCost) + gaussian) - kOutlierCost;
    EXPECT_NEAR(one.run(), expected, 1e-4);
    EXPECT_NEAR(one.weight[0][0], gaussian / (gaussian + std::exp(-kOutlierCost)), 1e-5);
  }
  EXPECT_NEAR(Association({50.0F}).run(), 0.0, 1e-6);
}

TEST(AssociationTest, NothingExplainsAPointFartherBesideTheBodiesThanTheyReach) {
  Association beside({0.5F, 1.0F}, label_beside(0.02F));
  beside.reach = 0.019F;
  EXPECT_NEAR(beside.run(), 0.0, 1e-6);
  EXPECT_EQ(beside.weight[0][0], 0.0F);
  beside.reach = 0.021F;
  EXPECT_EQ(beside.run(), Association({0.5F, 1.0F}, label_beside(0.0F)).run());
  EXPECT_LT(beside.run(), -1.0);
}

TEST(AssociationTest, ABodyFarBeyondTheCutChangesNothing) {
  Association alone({1.0F});
  Association with_far({1.0F, 50.0F});
  EXPECT_NEAR(alone.run(), with_far.run(), 1e-5);
  EXPECT_NEAR(alone.weight[0][0], with_far.weight[0][0], 1e-5);
  EXPECT_LT(with_far.weight[1][0], 1e-20F);
}

TEST(AssociationTest, TiesHaveNoWinner) {
  Association tie({0.7F, 0.7F, 0.7F});
  tie.run();
  EXPECT_EQ(tie.weight[0][0], tie.weight[1][0]);
  EXPECT_EQ(tie.weight[1][0], tie.weight[2][0]);
}

TEST(AssociationTest, VisibilityDecidesBetweenBodiesThatAreAsNear) {
  Association near({0.7F, 0.7F}, 1.0F);
  near.run();
  EXPECT_NEAR(near.weight[1][0] / near.weight[0][0], Association::kOdds, 1e-3);
  Association moved({0.7F, 20.0F},
                    1.0F);  // the visible body has left: the other explains the point
  moved.run();
  EXPECT_GT(moved.weight[0][0], 0.99F);
}

TEST(AssociationTest, WeightsAreTheDerivativeOfTheCost) {
  const std::vector<float> start{0.4F, -1.3F, 2.6F};
  constexpr float kStep = 1e-2F;
  Association at(start, 2.0F);
  at.run();
  for (std::size_t l = 0; l < 3; ++l) {
    double cost[2];
    for (int side = 0; side < 2; ++side) {
      auto d = start;
      d[l] += side == 0 ? -kStep : kStep;
      cost[side] = Association(d, 2.0F).run();
    }
    const double numeric = (cost[1] - cost[0]) / (2.0 * static_cast<double>(kStep));
    EXPECT_NEAR(numeric, static_cast<double>(at.weight[l][0] * start[l]), 2e-3);
  }
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
