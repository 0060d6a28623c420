// SPDX-License-Identifier: BSD-3-Clause
// What lies beside the model is as near to its surface as the noise: only the outline tells them
// apart.
#include <gtest/gtest.h>

#include <algorithm>

#include "initialization/seen_model.hpp"
#include "lockbox/kernels/point_to_field.hpp"
#include "lockbox/registration/articulated_registration.hpp"
#include "lockbox/simulation/trajectory.hpp"

namespace lockbox {
namespace {

/// The block seen from that far, well from its side.
Configuration seen_askance(const ArticulatedModel& model, double distance) {
  Configuration configuration = rest_configuration(model.tree);
  configuration.T_camera_base = facing_pose(distance) *
                                Eigen::AngleAxisd(0.9, Eigen::Vector3d::UnitY()) *
                                Eigen::AngleAxisd(0.6, Eigen::Vector3d::UnitZ());
  return configuration;
}

double error_before(const Scene& scene) {
  const ArticulatedModel& model = shipped("rigid_block");
  const Configuration truth = seen_askance(model, 2.3);
  ArticulatedRegistration registration(model, {}, Executor());
  const auto& found = registration.align(seen(model, truth, scene), truth, {0.002, 30});
  const Eigen::Vector3d error =
      (truth.T_camera_base.inverse() * found.configuration.T_camera_base).translation();
  return error.norm();
}

TEST(Surroundings, TheWallThatTheObjectHangsOnDoesNotPullIt) {
  const double free = error_before(wall_behind(1.0));
  const double flush = error_before(wall_behind(0.0));
  EXPECT_LT(flush, free + 0.002);
}

TEST(Surroundings, PointsAreLabelledByTheirDistanceFromTheOutline) {
  const ArticulatedModel& model = shipped("rigid_block");
  const Configuration truth = seen_askance(model, 1.0);
  const TiledCloud cloud = seen(model, truth, wall_behind(0.0));
  BodyPoses poses;
  forward_kinematics(model.tree, truth, poses);
  VisibleSurface surface;
  surface.render(model, poses, cloud.camera(), Executor());
  const auto count = [&](const OutlineReach& reach, float label) {
    std::vector<float> labels;
    surface.label(cloud, reach, Executor(), labels);
    return std::count(labels.begin(), labels.end(), label);
  };
  constexpr double kCut = 4.0;
  const auto on_model = count({0.5, 0.0, kCut}, 0.0F);
  EXPECT_GT(on_model, 1000);
  EXPECT_EQ(count({0.5, 0.01, kCut}, 0.0F), on_model);
  const auto beside = count({0.5, 0.0, kCut}, kernels::kNoBody);
  EXPECT_GT(beside, 0);
  EXPECT_LT(beside, on_model);
  EXPECT_GT(count({0.5, 0.01, kCut}, kernels::kNoBody), 5 * beside);
  // Farther than anything, also what fills up the last vectors.
  EXPECT_EQ(count({0.5, 1e9, kCut}, kernels::kBeyondReach), 0);
}

}  // namespace
}  // namespace lockbox
