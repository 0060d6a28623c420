// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/view/view_detail.hpp"

#include <gtest/gtest.h>

#include "registration/mechanism.hpp"

namespace lockbox {
namespace {

const PinholeCamera kSensor{640, 480, 575.0, 575.0, 319.5, 239.5};

/// For the mechanism's plate of 0.4 m at a distance.
int columns_at(double metres, std::size_t point_budget) {
  const ArticulatedModel& model = mechanism();
  Configuration configuration = mechanism_start(model);
  configuration.T_camera_base.translation() = Eigen::Vector3d(0.0, 0.0, metres);
  BodyPoses poses;
  forward_kinematics(model.tree, configuration, poses);
  return view_columns(view_detail(point_budget).rays, model, poses, kSensor);
}

TEST(ViewDetail, GrowsWithTheBudget) {
  EXPECT_EQ(columns_at(0.5, 0), 320);
  EXPECT_EQ(columns_at(0.5, 40000), 320);
  EXPECT_EQ(columns_at(0.5, 20000), 320);
  EXPECT_EQ(columns_at(0.5, 5000), 160);
  EXPECT_EQ(columns_at(0.5, 600), 160);
}

TEST(ViewDetail, LeavesEdgesAndContoursOutOnlyForTheSakeOfTime) {
  EXPECT_EQ(view_detail(0).edge_patches_per_joint, kAllPatches);
  EXPECT_EQ(view_detail(0).contour_spacing, 1);
  EXPECT_EQ(view_detail(2000).edge_patches_per_joint, kAllPatches);
  EXPECT_EQ(view_detail(2000).contour_spacing, 1);
  EXPECT_GT(view_detail(1000).edge_patches_per_joint, 0U);
  EXPECT_LT(view_detail(1000).edge_patches_per_joint, kAllPatches);
  EXPECT_EQ(view_detail(1000).contour_spacing, 2);
  EXPECT_EQ(view_detail(600).edge_patches_per_joint, 0U);
  EXPECT_EQ(view_detail(600).contour_spacing, 4);
}

/// The few rays that a far model has are not thinned.
TEST(ViewDetail, IsFinerForAModelThatIsSmallInTheImage) {
  EXPECT_EQ(columns_at(2.0, 20000), 640);
  EXPECT_EQ(columns_at(2.0, 0), 640);
  EXPECT_EQ(columns_at(1.2, 2000), 320);
}

TEST(ViewDetail, CountsWhatReachesBehindTheCameraAsLarge) {
  EXPECT_EQ(columns_at(0.1, 20000), 320);
}

}  // namespace
}  // namespace lockbox
