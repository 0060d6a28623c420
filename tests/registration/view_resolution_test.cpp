// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/registration/view_resolution.hpp"

#include <gtest/gtest.h>

#include "mechanism.hpp"

namespace lockbox {
namespace {

const PinholeCamera kCamera{640, 480, 575.0, 575.0, 319.5, 239.5};

/// The mechanism's plate of 0.4 m at a distance.
ViewResolution at_distance(double metres, std::size_t point_budget) {
  const ArticulatedModel& model = mechanism();
  Configuration configuration = mechanism_start(model);
  configuration.T_camera_base.translation() = Eigen::Vector3d(0.0, 0.0, metres);
  BodyPoses poses;
  forward_kinematics(model.tree, configuration, poses);
  return view_resolution(model, poses, kCamera, point_budget);
}

TEST(ViewResolution, GrowsWithTheBudget) {
  EXPECT_EQ(at_distance(0.5, 0).columns, 320);
  EXPECT_EQ(at_distance(0.5, 40000).columns, 320);
  EXPECT_EQ(at_distance(0.5, 20000).columns, 320);
  EXPECT_EQ(at_distance(0.5, 20000).outline_spacing, 1);
  EXPECT_EQ(at_distance(0.5, 2000).columns, 160);
  EXPECT_EQ(at_distance(0.5, 2000).outline_spacing, 4);
}

/// The few rays that a far model has are not thinned.
TEST(ViewResolution, IsFinerForAModelThatIsSmallInTheImage) {
  EXPECT_EQ(at_distance(2.0, 20000).columns, 640);
  EXPECT_EQ(at_distance(2.0, 0).columns, 640);
  EXPECT_EQ(at_distance(1.2, 2000).columns, 320);
}

TEST(ViewResolution, CountsWhatReachesBehindTheCameraAsLarge) {
  EXPECT_EQ(at_distance(0.1, 20000).columns, 320);
}

}  // namespace
}  // namespace lockbox
