// SPDX-License-Identifier: BSD-3-Clause
// The mean of pixels of a face says where the face is, whatever was predicted.
#include "lockbox/view/block_averages.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "lockbox/cloud/image_points.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/view/predicted_view.hpp"
#include "lockbox/view/sampling_plan.hpp"
#include "registration/mechanism.hpp"

namespace lockbox {
namespace {

constexpr std::size_t kMany = 100000;

class BlockAveragesTest : public ::testing::Test {
 protected:
  const ArticulatedModel& model = mechanism();
  const Configuration truth = mechanism_start(model);

  /// As a view of every second pixel chooses them.
  BlockAverages averages(const TiledCloud& cloud, const Configuration& predicted,
                         std::size_t budget = kMany, int threads = 1) const {
    const Executor executor(threads);
    BodyPoses poses;
    forward_kinematics(model.tree, predicted, poses);
    VisibleSurface surface;
    surface.render(model, poses, cloud.camera(), cloud.camera().width / 2, executor);
    ViewEdges edges;
    edges.find(surface.view(), executor);
    SamplingPlan plan;
    plan.plan(surface.view(), edges, surface.reduction(), surface.view_camera().fx, 0.0, budget,
              executor);
    BlockAverages points;
    const ViewOptions options;
    points.begin(plan.density());
    executor.for_each(points.bands(), [&](std::size_t i) {
      points.fill_band({cloud, surface, plan.density(), 1, options}, i);
    });
    points.finish();
    return points;
  }

  static ImagePoints all_of(const TiledCloud& cloud) {
    ImagePoints points;
    points.assign(cloud, Executor(1));
    return points;
  }

  TiledCloud seen(const std::string& sensor) const {
    return cloud_of(measured(model, truth, sensor));
  }

  /// Metres to the nearest surface of the mechanism as it is.
  double distance(const Eigen::Vector3f& p) const {
    BodyPoses poses;
    forward_kinematics(model.tree, truth, poses);
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t b = 0; b < poses.size(); ++b) {
      if (!model.fields[b]) continue;
      const auto sample =
          model.fields[b]->sample((poses[b].inverse() * p.cast<double>()).cast<float>());
      nearest = std::min(nearest, std::abs(static_cast<double>(sample.distance)));
    }
    return nearest;
  }

  template <typename Visit>
  static void for_each_point(const PointTiles& points, const Visit& visit) {
    for (const Tile& tile : points.tiles()) {
      for (std::size_t i = tile.first; i < tile.first + tile.count; ++i) {
        visit(Eigen::Vector3f(points.x()[i], points.y()[i], points.z()[i]),
              points.averaged_pixels()[i]);
      }
    }
  }

  /// Root mean square of the means' distances, each as often as it has pixels, metres; without the
  /// pixels that stand for the smallest blocks, of which the view has one for four of the camera.
  double mean_distance(const BlockAverages& points) const {
    double squares = 0.0;
    double pixels = 0.0;
    for_each_point(points, [&](const Eigen::Vector3f& p, float count) {
      if (count <= 4.0F) return;
      squares += static_cast<double>(count) * std::pow(distance(p), 2);
      pixels += static_cast<double>(count);
    });
    return std::sqrt(squares / pixels);
  }

  /// Within two centimetres of the mechanism.
  double pixels_of(const BlockAverages& points) const {
    double pixels = 0.0;
    for_each_point(points, [&](const Eigen::Vector3f& p, float count) {
      if (distance(p) < 0.02) pixels += static_cast<double>(count);
    });
    return pixels;
  }
};

TEST_F(BlockAveragesTest, FewPointsStandForAllPixelsOfTheObject) {
  const TiledCloud cloud = seen("ideal");
  const BlockAverages points = averages(cloud, truth);
  double on_object = 0.0;
  for_each_point(all_of(cloud),
                 [&](const Eigen::Vector3f& p, float) { on_object += distance(p) < 0.002; });
  EXPECT_GT(pixels_of(points), 0.95 * on_object);
  EXPECT_LT(pixels_of(points), 1.05 * on_object);
  EXPECT_LT(static_cast<double>(points.valid_points()), 0.15 * on_object);
}

/// To what is left of depths in whole millimetres.
TEST_F(BlockAveragesTest, MeansLieOnTheFaces) {
  EXPECT_LT(mean_distance(averages(seen("ideal"), truth)), 5e-5);
}

/// A face that is predicted 4 mm and a degree elsewhere.
TEST_F(BlockAveragesTest, MeansLieOnTheFacesThatAreMeasured) {
  Configuration predicted = truth;
  Twist off;
  off << 0.0, 0.0, 0.004, 0.01, -0.01, 0.0;
  predicted.T_camera_base = predicted.T_camera_base * exp_se3(off);
  EXPECT_LT(mean_distance(averages(seen("ideal"), predicted)), 1e-4);
}

TEST_F(BlockAveragesTest, NoiseIsAveraged) {
  const TiledCloud cloud = seen("white");
  double squares = 0.0;
  double count = 0.0;
  for_each_point(all_of(cloud), [&](const Eigen::Vector3f& p, float) {
    if (distance(p) > 0.008) return;
    squares += std::pow(distance(p), 2);
    count += 1.0;
  });
  const double pixel = std::sqrt(squares / count);
  const BlockAverages points = averages(cloud, truth);
  EXPECT_LT(mean_distance(points), 0.25 * pixel);
  double scatter = 0.0;
  for (const Tile& tile : points.tiles()) {
    EXPECT_LT(tile.scatter, 2.0);
    scatter += tile.scatter * static_cast<double>(tile.count);
  }
  EXPECT_GT(scatter / static_cast<double>(points.valid_points()), 0.1);
}

TEST_F(BlockAveragesTest, WhatStandsBeforeAFaceIsNotPartOfIt) {
  const DepthFrame frame = measured(model, truth, "ideal");
  DepthFrame hidden = frame;
  const int columns = frame.camera.width;
  for (std::size_t i = 0; i < hidden.depth.size(); ++i) {
    if (static_cast<int>(i) % columns > columns / 2) hidden.depth[i] = 400;  // a hand at 0.4 m
  }
  const BlockAverages points = averages(cloud_of(hidden), truth);
  EXPECT_LT(mean_distance(points), 5e-5);
  EXPECT_LT(pixels_of(points), 0.7 * pixels_of(averages(cloud_of(frame), truth)));
}

TEST_F(BlockAveragesTest, OfASmallBudgetAreNotMoreThanThat) {
  const TiledCloud cloud = seen("ideal");
  for (const std::size_t budget : {500U, 1000U, 2000U}) {
    const BlockAverages points = averages(cloud, truth, budget);
    EXPECT_LE(points.valid_points(), budget);
    EXPECT_GT(pixels_of(points), 10.0 * static_cast<double>(points.valid_points()));
  }
}

TEST_F(BlockAveragesTest, AreTheSameForAnyNumberOfThreads) {
  const TiledCloud cloud = seen("primesense");
  const BlockAverages first = averages(cloud, truth);
  for (const int threads : {2, 3, 8}) {
    const BlockAverages again = averages(cloud, truth, kMany, threads);
    EXPECT_EQ(again.x(), first.x());
    EXPECT_EQ(again.z(), first.z());
    EXPECT_EQ(again.averaged_pixels(), first.averaged_pixels());
    ASSERT_EQ(again.tiles().size(), first.tiles().size());
  }
}

/// Pixels that were left out are still in the image, and must not come back in a mean.
TEST_F(BlockAveragesTest, OfACloudOfWhichSomeWasLeftOutAreNotUsed) {
  TiledCloud cloud = seen("ideal");
  PredictedView view(0, view_detail(0));
  view.look_at(cloud, model, truth, 0.0, true, {}, Executor(1));
  EXPECT_TRUE(view.has_own_tiles());
  cloud.keep(std::vector<std::uint8_t>(cloud.depth().size(), 1));
  view.look_at(cloud, model, truth, 0.0, true, {}, Executor(1));
  EXPECT_FALSE(view.has_own_tiles());
}

}  // namespace
}  // namespace lockbox
