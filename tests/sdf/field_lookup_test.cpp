// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <limits>
#include <utility>

#include "field_fixture.hpp"
#include "lockbox/mesh/primitives.hpp"

namespace lockbox {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

/// Distance to an axis-aligned box about the origin.
double box_distance(const Vector3d& p, const Vector3d& half) {
  const Vector3d q = p.cwiseAbs() - half;
  return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0);
}

class FieldLookup : public testing::Test {
 protected:
  static const SignedDistanceField& field() {
    static const SignedDistanceField field = field_of(make_box({0.1, 0.06, 0.04}), 0.002, 0.5);
    return field;
  }
  Vector3d half_ = Vector3d(0.05, 0.03, 0.02);
};

TEST_F(FieldLookup, GradientIsTheDerivativeWithinCells) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(-1.0F, 1.0F);
  const FieldView& view = field().view();
  const float step = 0.05F * view.fine_voxel;
  int tested = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vector3f p(0.07F * uniform(random), 0.05F * uniform(random), 0.04F * uniform(random));
    const Vector3f g = (p - Vector3f(view.fine_origin)) / view.fine_voxel;
    const Vector3f within = g - g.array().floor().matrix();
    if (within.minCoeff() < 0.1F || within.maxCoeff() > 0.9F) {
      continue;
    }
    ++tested;
    const DistanceSample sample = field().sample(p);
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3f offset = step * Vector3f::Unit(axis);
      const float numeric =
          (field().sample(p + offset).distance - field().sample(p - offset).distance) /
          (2.0F * step);
      EXPECT_NEAR(sample.gradient[axis], numeric, 2e-3F) << p.transpose();
    }
  }
  EXPECT_GT(tested, 1000);
}

TEST_F(FieldLookup, FarFieldErrorIsBounded) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-0.5, 0.5);
  double largest = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const Vector3d p(uniform(random), uniform(random), uniform(random));
    const double error =
        static_cast<double>(field().sample(p.cast<float>()).distance) - box_distance(p, half_);
    largest = std::max(largest, std::abs(error));
  }
  EXPECT_LT(largest, 0.2 * static_cast<double>(field().view().coarse_voxel));
}

TEST_F(FieldLookup, WhatIsNotFiniteIsFarOutsideWithoutAGradient) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  constexpr float kLargest = std::numeric_limits<float>::max();
  for (const float value : {kNaN, kInfinity, -kInfinity, kLargest, -kLargest}) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const Vector3f& p :
           {Vector3f(value * Vector3f::Unit(axis)), Vector3f(Vector3f::Constant(value))}) {
        SCOPED_TRACE(p.transpose());
        const DistanceSample sample = field().sample(p);
        EXPECT_EQ(sample.distance, kInfinity);
        EXPECT_EQ(sample.gradient, Vector3f::Zero());
      }
    }
  }
}

TEST_F(FieldLookup, StepsLittleFromFineToCoarse) {
  // Along rays outwards: no step between neighbours but the way between them and a small jump.
  std::mt19937 random(3);
  std::normal_distribution<float> normal;
  float largest_jump = 0.0F;
  const float step = 2e-4F;
  for (int ray = 0; ray < 200; ++ray) {
    const Vector3f direction =
        Vector3f(normal(random), normal(random), normal(random)).normalized();
    float previous = field().sample(Vector3f::Zero()).distance;
    for (float way = step; way < 0.2F; way += step) {
      const float distance = field().sample(way * direction).distance;
      largest_jump = std::max(largest_jump, std::abs(distance - previous) - step);
      previous = distance;
    }
  }
  EXPECT_LT(largest_jump, 0.2F * field().view().coarse_voxel);
}

TEST_F(FieldLookup, BeyondTheGridTheWayIsAdded) {
  for (const Vector3f& direction :
       {Vector3f(1, 0, 0), Vector3f(0, -1, 0), Vector3f(0.6F, 0.0F, 0.8F)}) {
    const DistanceSample far = field().sample(5.0F * direction);
    EXPECT_NEAR(static_cast<double>(far.distance),
                box_distance(5.0 * direction.cast<double>(), half_), 0.4);
    EXPECT_NEAR(far.gradient.norm(), 1.0F, 1e-5F);
    EXPECT_GT(far.gradient.dot(direction), 0.8F);
  }
}

TEST_F(FieldLookup, StaysWithinTheArraysAtEveryBorder) {
  const FieldView& view = field().view();
  const Vector3f low(view.coarse_origin);
  const Vector3f size(static_cast<float>(view.coarse_size[0] - 1),
                      static_cast<float>(view.coarse_size[1] - 1),
                      static_cast<float>(view.coarse_size[2] - 1));
  const Vector3f fine_low(view.fine_origin);
  const Vector3f fine_size(static_cast<float>(kBlockCells * view.blocks[0]),
                           static_cast<float>(kBlockCells * view.blocks[1]),
                           static_cast<float>(kBlockCells * view.blocks[2]));
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3f side(static_cast<float>(corner & 1), static_cast<float>((corner >> 1) & 1),
                        static_cast<float>(corner >> 2));
    const Vector3f coarse = low + view.coarse_voxel * size.cwiseProduct(side);
    const Vector3f fine = fine_low + view.fine_voxel * fine_size.cwiseProduct(side);
    EXPECT_NEAR(static_cast<double>(field().sample(coarse).distance),
                box_distance(coarse.cast<double>(), half_), 0.005);
    EXPECT_NEAR(static_cast<double>(field().sample(fine).distance),
                box_distance(fine.cast<double>(), half_), 0.005);
  }
}

TEST(Field, KeepsItsViewWhenMoved) {
  SignedDistanceField field = field_of(make_box({0.02, 0.02, 0.02}));
  const float before = field.sample({0.01F, 0.02F, 0.0F}).distance;
  const SignedDistanceField target = std::move(field);
  EXPECT_EQ(target.view().samples, target.storage().samples.data());
  EXPECT_EQ(target.sample({0.01F, 0.02F, 0.0F}).distance, before);
}

TEST(Field, StoresOneSpareSampleForPairLoads) {
  const SignedDistanceField field = field_of(make_box({0.02, 0.02, 0.02}));
  const auto& storage = field.storage();
  std::size_t blocks = 0;
  for (const std::int32_t first : storage.block_first) {
    blocks += first >= 0 ? 1U : 0U;
  }
  const FieldView& view = field.view();
  const auto coarse = static_cast<std::size_t>(view.coarse_size[0]) *
                      static_cast<std::size_t>(view.coarse_size[1]) *
                      static_cast<std::size_t>(view.coarse_size[2]);
  EXPECT_EQ(storage.samples.size(), coarse + blocks * kBlockVolume + 1);
}

}  // namespace
}  // namespace lockbox
