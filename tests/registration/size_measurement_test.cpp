// SPDX-License-Identifier: BSD-3-Clause
// How large the object looks may be asked of any cloud, at any time.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "initialization/seen_model.hpp"
#include "lockbox/registration/articulated_registration.hpp"

namespace lockbox {
namespace {

class SizeMeasured : public ::testing::Test {
 protected:
  TiledCloud seen(std::uint64_t number) const {
    return lockbox::seen(model_, truth_, wall_behind(1.0), number);
  }

  static void expect_same(const SizeMeasurement& a, const SizeMeasurement& b) {
    EXPECT_EQ(a.value, b.value);
    EXPECT_EQ(a.covariance, b.covariance);
    EXPECT_EQ(a.effect, b.effect);
  }

  const AlignOptions near_{.annealing_sigma = 0.005, .iterations = 12, .narrowing = 6};
  const ArticulatedModel& model_ = shipped("rigid_block");
  const Configuration truth_ = facing(model_, 1.0, 0.5, 0.3);
  ArticulatedRegistration registration_{model_, {}, Executor()};
};

TEST_F(SizeMeasured, BeforeAnyAlignment) {
  const SizeMeasurement size = registration_.measure_size(seen(0), truth_);
  EXPECT_NEAR(size.value[0], 1.0, 0.005);
  EXPECT_NEAR(size.value[1], 1.0, 0.02);
  EXPECT_LT(std::sqrt(size.covariance(0, 0)), 0.005);
  EXPECT_EQ(size.effect.rows(), 6);
}

TEST_F(SizeMeasured, WhenTheCloudOfTheLastAlignmentIsGone) {
  const TiledCloud next = seen(1);
  const SizeMeasurement expected = registration_.measure_size(next, truth_);
  registration_.align(seen(0), truth_, near_);
  expect_same(registration_.measure_size(next, truth_), expected);
}

TEST_F(SizeMeasured, WithoutAnImageIsUnknown) {
  TiledCloud points;
  points.assign_unorganized(std::vector<Eigen::Vector3f>{{0.0F, 0.0F, 1.0F}}, {});
  expect_same(registration_.measure_size(points, truth_), {});
}

TEST_F(SizeMeasured, ChangesNoLaterAlignment) {
  const TiledCloud cloud = seen(0);
  const TiledCloud other = seen(1);
  AlignOptions going_on = near_;
  going_on.goes_on = true;
  const auto found_after = [&](bool is_measured) {
    ArticulatedRegistration registration(model_, {}, Executor());
    const Configuration first = registration.align(cloud, truth_, near_).at_rest;
    if (is_measured) {
      registration.measure_size(cloud, first);
      registration.measure_size(other, first);
    }
    return registration.align(cloud, first, going_on).configuration.T_camera_base;
  };
  EXPECT_EQ(found_after(true).matrix(), found_after(false).matrix());
}

}  // namespace
}  // namespace lockbox
