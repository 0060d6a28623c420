// SPDX-License-Identifier: BSD-3-Clause
// What lies beside the model is as near to its surface as the noise: only the contour tells them
// apart.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "initialization/seen_model.hpp"
#include "lockbox/cloud/image_points.hpp"
#include "lockbox/kernels/point_to_field.hpp"
#include "lockbox/registration/articulated_registration.hpp"
#include "lockbox/simulation/trajectory.hpp"
#include "lockbox/view/continued_edges.hpp"

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

/// Steps along rows and columns from a pixel to the nearest one that shows a body.
int steps_to_model(const RenderedDepth& view, int u, int v) {
  int least = view.width + view.height;
  for (int row = 0; row < view.height; ++row) {
    for (int column = 0; column < view.width; ++column) {
      if (view.id[static_cast<std::size_t>(row * view.width + column)] != kNothing) {
        least = std::min(least, std::abs(row - v) + std::abs(column - u));
      }
    }
  }
  return least;
}

TEST(Surroundings, PointsAreLabelledByTheirDistanceFromTheContour) {
  const ArticulatedModel& model = shipped("rigid_block");
  const Configuration truth = seen_askance(model, 1.0);
  const TiledCloud cloud = seen(model, truth, wall_behind(0.0));
  BodyPoses poses;
  forward_kinematics(model.tree, truth, poses);
  VisibleSurface surface;
  surface.render(model, poses, cloud.camera(), cloud.camera().width, Executor());
  PixelPrediction predicted;
  ImagePoints points;
  points.assign(cloud, Executor());
  surface.predict(points, ContinuedEdges(), Executor(), predicted);
  int beside = 0;
  for (std::size_t t = 0; t < points.tiles().size(); t += 7) {
    if (points.tiles()[t].count == 0) continue;
    const std::size_t point = points.tiles()[t].first;
    const auto pixel = static_cast<int>(points.pixel()[point]);
    const int width = cloud.camera().width;
    const int steps = std::min(steps_to_model(surface.view(), pixel % width, pixel / width), 255);
    if (steps == 0) {
      EXPECT_EQ(predicted.body[point], 0.0F);
      EXPECT_NEAR(predicted.depth[point], points.z()[point], 0.02);
      continue;
    }
    const double metres = steps / cloud.camera().fx * points.z()[point];
    EXPECT_EQ(predicted.depth[point], 0.0F);
    EXPECT_NEAR(predicted.body[point], kernels::label_beside(static_cast<float>(metres)), 1e-6);
    beside += steps < 100 ? 1 : 0;
  }
  EXPECT_GT(beside, 20);
}

}  // namespace
}  // namespace lockbox
