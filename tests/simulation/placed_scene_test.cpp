// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/simulation/placed_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "lockbox/core/lie.hpp"
#include "lockbox/simulation/trajectory.hpp"

namespace lockbox {
namespace {

const PinholeCamera kSmallCamera{160, 120, 143.95, 143.95, 79.5, 59.5};

State state_at(double stamp, const Eigen::Isometry3d& T_camera_base) {
  State state;
  state.stamp = stamp;
  state.configuration.T_camera_base = T_camera_base;
  return state;
}

RenderedDepth seen(const PlacedScene& scene, const State& state) {
  std::vector<RenderItem> items;
  scene.append_items(state, items);
  DepthRenderer renderer(kSmallCamera, Executor(1));
  RenderedDepth image;
  renderer.render(items, image);
  return image;
}

double middle_depth(const RenderedDepth& image) {
  return image.depth[static_cast<std::size_t>(60 * 160 + 80)];
}

Scene wall(SceneFrame frame, const Eigen::Vector3d& point, Moving moving) {
  Scene scene;
  scene.moving = moving;
  scene.planes.push_back({frame, point, Eigen::Vector3d::UnitZ(), {20.0, 20.0}});
  return scene;
}

TEST(PlacedScene, EmptySceneShowsNothing) {
  std::vector<RenderItem> items;
  PlacedScene().append_items(state_at(0.0, facing_pose(1.0)), items);
  EXPECT_TRUE(items.empty());
}

TEST(PlacedScene, WorldIsTheCamerasFrameAndBaseTheModelsAtTheStart) {
  const State start = state_at(0.0, facing_pose(1.2));
  const PlacedScene world(wall(SceneFrame::world, {0, 0, 2}, Moving::object), {start});
  EXPECT_NEAR(middle_depth(seen(world, start)), 2.0, 1e-6);
  // The base's z axis points to the camera: 0.5 m behind the base is 1.7 m away.
  const PlacedScene base(wall(SceneFrame::base, {0, 0, -0.5}, Moving::object), {start});
  EXPECT_NEAR(middle_depth(seen(base, start)), 1.7, 1e-6);
  EXPECT_EQ(seen(base, start).id[0], kBackgroundId);
}

TEST(PlacedScene, BackgroundStaysWhenTheObjectMovesAndGoesAlongWhenTheCameraDoes) {
  const State start = state_at(0.0, facing_pose(1.2));
  const State later = state_at(1.0, facing_pose(1.0));
  for (const SceneFrame frame : {SceneFrame::world, SceneFrame::base}) {
    const Eigen::Vector3d point(0, 0, frame == SceneFrame::world ? 2.0 : -0.8);
    const PlacedScene still(wall(frame, point, Moving::object), {start, later});
    EXPECT_NEAR(middle_depth(seen(still, later)), 2.0, 1e-6);
    const PlacedScene moving(wall(frame, point, Moving::camera), {start, later});
    EXPECT_NEAR(middle_depth(seen(moving, later)), 1.8, 1e-6);
  }
}

TEST(PlacedScene, BoxShowsItsNearFace) {
  Scene scene;
  SceneBox box;
  box.size = {0.4, 0.2, 0.6};
  box.pose.translation() = Eigen::Vector3d(0, 0, 2);
  scene.boxes.push_back(box);
  const State start = state_at(0.0, facing_pose(1.2));
  const RenderedDepth image = seen(PlacedScene(scene, {start}), start);
  EXPECT_NEAR(middle_depth(image), 1.7, 1e-6);
  // 0.4 m x 0.2 m at 1.7 m: 33.87 x 16.9 pixels.
  const auto pixels = std::count(image.id.begin(), image.id.end(), kBackgroundId);
  EXPECT_NEAR(static_cast<double>(pixels), 33.87 * 16.9, 40.0);
}

SceneArm pointing_arm() {
  SceneArm arm;
  arm.frame = SceneFrame::world;
  arm.waypoints = {{0.25, {-0.4, 0, 1.0}, {-0.1, 0, 1.0}}, {0.75, {-0.4, 0, 1.0}, {0.1, 0, 1.0}}};
  return arm;
}

/// The last column of the arm; -1 if it is not there.
int rightmost(const RenderedDepth& image) {
  int last = -1;
  for (std::size_t i = 0; i < image.id.size(); ++i) {
    last = image.id[i] == kOccluderId ? std::max(last, static_cast<int>(i % 160)) : last;
  }
  return last;
}

TEST(PlacedScene, ArmIsThereBetweenItsFirstAndLastWaypoint) {
  Scene scene;
  scene.arms.push_back(pointing_arm());
  const std::vector<State> run = {state_at(10.0, facing_pose(1.2)),
                                  state_at(14.0, facing_pose(1.2))};
  const PlacedScene placed(scene, run);
  const auto at = [&](double stamp) {
    return rightmost(seen(placed, state_at(stamp, facing_pose(1.2))));
  };
  EXPECT_EQ(at(10.0), -1);
  EXPECT_EQ(at(10.99), -1);
  EXPECT_EQ(at(13.01), -1);
  EXPECT_GT(at(11.0), 0);
  EXPECT_GT(at(12.0), at(11.0));
  EXPECT_GT(at(13.0), at(12.0));
}

TEST(PlacedScene, ArmReachesFromShoulderToFingerTips) {
  Scene scene;
  SceneArm arm = pointing_arm();
  // Stretched: shoulder at -0.4 m, wrist 0.56 m on at 0.16 m, finger tips at 0.34 m.
  arm.waypoints[0].wrist = arm.waypoints[1].wrist = {0.16, 0, 1.0};
  scene.arms.push_back(arm);
  const std::vector<State> run = {state_at(0.0, facing_pose(1.2)), state_at(1.0, facing_pose(1.2))};
  const RenderedDepth image = seen(PlacedScene(scene, run), state_at(0.5, facing_pose(1.2)));
  EXPECT_NEAR(rightmost(image), 79.5 + 143.95 * 0.34, 1.5);
  EXPECT_NEAR(middle_depth(image), 0.95, 1e-3);  // the radius of 5 cm before the axis
}

TEST(PlacedScene, WristOutOfReachLeavesTheArmStretched) {
  Scene scene;
  SceneArm arm = pointing_arm();
  arm.waypoints[0].wrist = arm.waypoints[1].wrist = {5.0, 0, 1.0};
  scene.arms.push_back(arm);
  const std::vector<State> run = {state_at(0.0, facing_pose(1.2)), state_at(1.0, facing_pose(1.2))};
  const RenderedDepth image = seen(PlacedScene(scene, run), state_at(0.5, facing_pose(1.2)));
  EXPECT_NEAR(rightmost(image), 79.5 + 143.95 * 0.34, 1.5);
}

}  // namespace
}  // namespace lockbox
