// SPDX-License-Identifier: BSD-3-Clause
// What the image does not determine does not move: a carton flush with its neighbours shows one
// face, and nothing of where that face ends.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "initialization/seen_model.hpp"
#include "lockbox/core/units.hpp"
#include "lockbox/tracking/tracker.hpp"

namespace lockbox {
namespace {

const Eigen::Vector3d kCarton(0.3, 0.2, 0.25);  // metres, share/models/carton

/// Behind all models.
Scene far_wall() {
  Scene scene;
  scene.planes.push_back(
      {SceneFrame::world, {0.0, 0.0, 2.5}, -Eigen::Vector3d::UnitZ(), {8.0, 8.0}});
  return scene;
}

/// Cartons around those that the model consists of, whose centres lie at these multiples of the
/// width.
Scene among_cartons(const std::vector<double>& own, int columns) {
  Scene scene = far_wall();
  for (int row = -1; row <= 1; ++row) {
    for (int column = 0; column < columns; ++column) {
      const double across = column - 0.5 * (columns - 1);
      const bool is_own = row == 0 && std::find(own.begin(), own.end(), across) != own.end();
      if (is_own) continue;
      const Eigen::Translation3d place(across * kCarton.x(), row * kCarton.y(), 0.0);
      scene.boxes.push_back({SceneFrame::base, kCarton, Eigen::Isometry3d(place)});
    }
  }
  return scene;
}

/// A centimetre and three degrees off.
Configuration displaced(const Configuration& truth) {
  Configuration start = truth;
  start.T_camera_base.pretranslate(Eigen::Vector3d(0.01, 0.0, 0.0));
  start.T_camera_base.rotate(Eigen::AngleAxisd(3.0 * kRadians, Eigen::Vector3d::UnitY()));
  return start;
}

/// Metres within the plane of the face, and radians about its normal.
struct InPlane {
  InPlane(const Configuration& from, const Configuration& to) {
    const Eigen::Isometry3d moved = from.T_camera_base.inverse() * to.T_camera_base;
    distance = moved.translation().head<2>().norm();
    angle = std::abs(std::atan2(moved.linear()(1, 0), moved.linear()(0, 0)));
  }
  double distance;
  double angle;
};

class Flush : public ::testing::Test {
 protected:
  /// Frames with noise of their own.
  void track(Tracker& tracker, const ArticulatedModel& model, const Scene& scene, int frames) {
    const Configuration truth = *model.parameters.initial_configuration;
    tracker.start(displaced(truth));
    for (int i = 0; i < frames; ++i) {
      DepthFrame frame = seen_frame(model, truth, scene, static_cast<std::uint64_t>(i));
      frame.stamp = i / 30.0;
      results_.push_back(tracker.process(frame));
    }
  }

  std::vector<TrackingResult> results_;
};

TEST_F(Flush, ACartonRestsAlongItsFace) {
  const ArticulatedModel& model = shipped("carton");
  Tracker tracker(model, {});
  track(tracker, model, among_cartons({0.0}, 3), 8);
  for (const TrackingResult& result : results_) {
    EXPECT_EQ(result.status, TrackingStatus::uncertain);
    EXPECT_FALSE(result.observable[0] && result.observable[1]);
    const InPlane moved(results_.front().configuration, result.configuration);
    EXPECT_LT(moved.distance, 1e-3);
    EXPECT_LT(moved.angle, 0.5 * kRadians);
  }
  // What the face tells is known.
  const double z = results_.back().configuration.T_camera_base.translation().z();
  EXPECT_NEAR(z, model.parameters.initial_configuration->T_camera_base.translation().z(), 0.005);
}

/// The end of a row: its free side tells where it is across, nothing tells how high.
TEST_F(Flush, ACartonIsHeldByItsOneFreeSide) {
  const ArticulatedModel& model = shipped("carton");
  const Configuration truth = *model.parameters.initial_configuration;
  Scene scene = far_wall();
  for (int row = -1; row <= 1; ++row) {
    for (int column = -1; column <= 0; ++column) {
      if (row == 0 && column == 0) continue;
      const Eigen::Translation3d place(column * kCarton.x(), row * kCarton.y(), 0.0);
      scene.boxes.push_back({SceneFrame::base, kCarton, Eigen::Isometry3d(place)});
    }
  }
  Tracker tracker(model, {});
  track(tracker, model, scene, 8);
  const Eigen::Isometry3d off =
      truth.T_camera_base.inverse() * results_.back().configuration.T_camera_base;
  EXPECT_LT(std::abs(off.translation().x()), 0.004);
  const InPlane moved(results_[2].configuration, results_.back().configuration);
  EXPECT_LT(moved.distance, 2e-3);
}

TEST_F(Flush, ACartonIsKeptWhileLiveFramesDoNotWaitForSearches) {
  const ArticulatedModel& model = shipped("carton");
  TrackerOptions options;
  options.background_search = true;
  Tracker tracker(model, options);
  track(tracker, model, among_cartons({0.0}, 3), 30);
  EXPECT_EQ(results_.back().status, TrackingStatus::uncertain);
  const InPlane moved(displaced(*model.parameters.initial_configuration),
                      results_.back().configuration);
  EXPECT_LT(moved.distance, 0.03);
}

TEST_F(Flush, AJointBetweenCartonsRests) {
  const ArticulatedModel& model = shipped("carton_pair");
  Tracker tracker(model, {});
  track(tracker, model, among_cartons({-0.5, 0.5}, 4), 8);
  for (const TrackingResult& result : results_) {
    EXPECT_EQ(result.status, TrackingStatus::uncertain);
    EXPECT_FALSE(result.observable[6]);
    EXPECT_LT(std::abs(result.configuration.q[0] - results_.front().configuration.q[0]), 1e-4);
  }
}

TEST(ARepeatedImage, IsAFixedPoint) {
  for (const char* const name : {"rigid_block", "board_door_block"}) {
    const ArticulatedModel& model = shipped(name);
    Configuration truth = rest_configuration(model.tree);
    if (model.parameters.initial_configuration) truth = *model.parameters.initial_configuration;
    DepthFrame frame = seen_frame(model, truth, far_wall());
    Tracker tracker(model, {});
    tracker.start(truth);
    std::optional<Configuration> rest;
    for (int i = 0; i < 16; ++i) {
      frame.stamp = i / 30.0;
      const TrackingResult& result = tracker.process(frame);
      EXPECT_EQ(result.stamp, frame.stamp);
      EXPECT_EQ(result.status, TrackingStatus::tracking) << name;
      if (i < 10) continue;
      if (!rest) rest = result.configuration;
      const Eigen::Isometry3d moved =
          rest->T_camera_base.inverse() * result.configuration.T_camera_base;
      EXPECT_LT(moved.translation().norm(), 1e-4) << name;
      EXPECT_LT(Eigen::AngleAxisd(moved.linear()).angle(), 0.01 * kRadians) << name;
      if (rest->q.size() > 0) {
        EXPECT_LT((result.configuration.q - rest->q).cwiseAbs().maxCoeff(), 1e-4) << name;
      }
    }
  }
}

TEST(ARepeatedImage, ThatChangesAgainIsFollowed) {
  const ArticulatedModel& model = shipped("rigid_block");
  Configuration truth = *model.parameters.initial_configuration;
  Tracker tracker(model, {});
  tracker.start(truth);
  DepthFrame frame = seen_frame(model, truth, far_wall());
  for (int i = 0; i < 12; ++i) {
    frame.stamp = i / 30.0;
    tracker.process(frame);
  }
  truth.T_camera_base.pretranslate(Eigen::Vector3d(0.01, 0.0, 0.0));
  DepthFrame moved = seen_frame(model, truth, far_wall(), 1);
  moved.stamp = 12 / 30.0;
  const TrackingResult& result = tracker.process(moved);
  EXPECT_EQ(result.status, TrackingStatus::tracking);
  EXPECT_LT(
      (result.configuration.T_camera_base.translation() - truth.T_camera_base.translation()).norm(),
      0.003);
}

}  // namespace
}  // namespace lockbox
