// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/simulation/model_visibility.hpp"

#include <gtest/gtest.h>

#include "lockbox/simulation/trajectory.hpp"
#include "small_models.hpp"

namespace lockbox {
namespace {

const PinholeCamera kPlateCamera{160, 120, 143.95, 143.95, 79.5, 59.5};

/// A plate that fills a third of the image.
KinematicTree plate() {
  KinematicTree tree;
  tree.bodies = {testing::box_body("plate", {0.4, 0.4, 0.02}, -1)};
  return tree;
}

ModelVisibility visibility(const Eigen::Isometry3d& T_camera_base, const Scene& scene = {}) {
  const KinematicTree tree = plate();
  State state;
  state.configuration.T_camera_base = T_camera_base;
  state.configuration.q.resize(0);
  return VisibilityMeter(tree, kPlateCamera, PlacedScene(scene, {state}), Executor(1))
      .measure(state);
}

Eigen::Isometry3d aside(double x) {
  Eigen::Isometry3d T_camera_base = facing_pose(1.0);
  T_camera_base.translation().x() = x;
  return T_camera_base;
}

TEST(ModelVisibility, IsWholeInTheMiddleOfTheImage) {
  const ModelVisibility whole = visibility(facing_pose(1.0));
  EXPECT_EQ(whole.cut, 0.0);
  EXPECT_EQ(whole.hidden, 0.0);
}

TEST(ModelVisibility, IsCutByTheBorderOfTheImage) {
  const double border = 80.0 / 143.95;  // metres from the optical axis, one metre away
  EXPECT_NEAR(visibility(aside(border)).cut, 0.5, 0.03);
  EXPECT_NEAR(visibility(aside(-border - 0.1)).cut, 0.75, 0.03);
  EXPECT_EQ(visibility(aside(border)).hidden, 0.0);
}

TEST(ModelVisibility, IsNoneOutsideTheImageAndBehindTheCamera) {
  EXPECT_EQ(visibility(aside(8.0)).cut, 1.0);
  EXPECT_EQ(visibility(facing_pose(-1.0)).cut, 1.0);
}

TEST(ModelVisibility, IsHiddenByWhatStandsBeforeIt) {
  Scene scene;
  SceneBox box;  // before the left half of the plate
  box.size = {1.0, 1.0, 0.01};
  box.pose.translation() = Eigen::Vector3d(-0.5, 0.0, 0.9);
  scene.boxes = {box};
  const ModelVisibility half = visibility(facing_pose(1.0), scene);
  EXPECT_NEAR(half.hidden, 0.5, 0.03);
  EXPECT_EQ(half.cut, 0.0);
  scene.boxes[0].pose.translation().z() = 1.2;
  EXPECT_EQ(visibility(facing_pose(1.0), scene).hidden, 0.0);
}

}  // namespace
}  // namespace lockbox
