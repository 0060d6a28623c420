// SPDX-License-Identifier: BSD-3-Clause
// Scenes in which something hides the object, pulls at it, or passes for it, searched without a
// guess: what is there is found, and what is not there is never called `tracking`.
#include <gtest/gtest.h>

#include <algorithm>

#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/simulation/trajectory.hpp"
#include "lockbox/tracking/tracker.hpp"
#include "seen_model.hpp"

namespace lockbox {
namespace {

// What counts as right (docs/experiments.md).
constexpr double kRightPlace = 0.02;   // metres
constexpr double kRightTurn = 0.035;   // radians, of the base: 2 degrees
constexpr double kRightHinge = 0.087;  // radians: 5 degrees

/// Of the whole model at rest, base frame.
Eigen::AlignedBox3d box_around(const ArticulatedModel& model) {
  BodyPoses poses;
  forward_kinematics(model.tree, rest_configuration(model.tree), poses);
  Eigen::AlignedBox3d box;
  for (std::size_t b = 0; b < poses.size(); ++b) {
    box.extend(model.fields[b]->bounds().transformed(poses[b]));
  }
  return box;
}

SceneBox box_in(SceneFrame frame, const Eigen::Vector3d& size, const Eigen::Vector3d& centre) {
  return {frame, size, Eigen::Isometry3d(Eigen::Translation3d(centre))};
}

TrackingResult first_answer(const ArticulatedModel& model, const Configuration& truth,
                            const Scene& scene) {
  return Tracker(model, {}).process(seen_frame(model, truth, scene));
}

bool is_base_right(const Configuration& found, const Configuration& truth) {
  const Eigen::Isometry3d error = found.T_camera_base.inverse() * truth.T_camera_base;
  return error.translation().norm() < kRightPlace &&
         Eigen::AngleAxisd(error.linear()).angle() < kRightTurn;
}

void expect_found(const TrackingResult& result, const Configuration& truth) {
  EXPECT_EQ(result.status, TrackingStatus::tracking);
  EXPECT_TRUE(is_base_right(result.configuration, truth));
}

void expect_not_trusted_wrongly(const TrackingResult& result, const Configuration& truth) {
  EXPECT_TRUE(result.status != TrackingStatus::tracking ||
              is_base_right(result.configuration, truth));
}

TEST(HardScenes, ABoardIsFoundOfWhichABoxHidesAThird) {
  const ArticulatedModel& model = shipped("lockbox");
  const Configuration truth = facing(model, 1.4, 0.2, 0.1);
  Scene scene = wall_behind(0.6);
  const double right = box_around(model).max().x();
  scene.boxes.push_back(
      box_in(SceneFrame::base, {0.6 * right, 1.0, 0.1}, {0.7 * right, 0.0, 0.25}));
  expect_found(first_answer(model, truth, scene), truth);
}

TEST(HardScenes, ALargerBoxBesideABoardDoesNotPullItAway) {
  const ArticulatedModel& model = shipped("lockbox");
  const Configuration truth = facing(model, 1.5, -0.3, 0.0);
  Scene scene = wall_behind(0.8);
  const double right = box_around(model).max().x();
  scene.boxes.push_back(box_in(SceneFrame::base, {0.5, 0.7, 0.3}, {right + 0.27, 0.0, -0.1}));
  expect_found(first_answer(model, truth, scene), truth);
}

TEST(HardScenes, ATableDoesNotPullWhatStandsOnIt) {
  const ArticulatedModel& model = shipped("cabinet");
  const Configuration truth = facing(model, 1.4, 0.5, 0.0);
  Scene scene = wall_behind(1.0);
  scene.planes.push_back({SceneFrame::base,
                          {0.0, box_around(model).min().y(), 0.0},
                          Eigen::Vector3d::UnitY(),
                          {2.0, 1.2}});
  expect_found(first_answer(model, truth, scene), truth);
}

/// A box of its height and depth, nearer, of which the image's edge hides how long it is.
TEST(HardScenes, ALargeBoxThatIsCutOffDoesNotEndTheSearch) {
  const ArticulatedModel& model = shipped("cabinet");
  Configuration truth = rest_configuration(model.tree);
  truth.T_camera_base = Eigen::Translation3d(-0.4326, 0.2018, 2.1273) *
                        Eigen::Quaterniond(0.1326, 0.7042, -0.6525, 0.2467).normalized();
  set_joint_position(model.tree, truth, "door", 1.364);
  set_joint_position(model.tree, truth, "inner_drawer", 0.056);
  Scene scene;
  scene.boxes.push_back(  // that it stands on
      box_in(SceneFrame::base, {1.572, 0.04, 0.812}, {0.154, -0.27, -0.02}));
  scene.planes.push_back({SceneFrame::base, {0.0, 0.0, -0.955}, Eigen::Vector3d::UnitZ()});
  SceneBox box = box_in(SceneFrame::base, {0.400, 0.492, 0.478}, {0.195, -0.550, 1.042});
  box.pose.linear() = Eigen::Quaterniond(0.5531, 0.2628, -0.1032, -0.7838).normalized().matrix();
  scene.boxes.push_back(box);
  expect_found(first_answer(model, truth, scene), truth);
}

TEST(HardScenes, WhatAnOpenDoorShowsIsNoReasonToDoubtIt) {
  const ArticulatedModel& model = shipped("cabinet");
  Configuration truth = facing(model, 1.3, -0.3, 0.0);
  set_joint_position(model.tree, truth, "door", 1.2);
  set_joint_position(model.tree, truth, "drawer", 0.12);
  const TrackingResult result = first_answer(model, truth, wall_behind(0.8));
  expect_found(result, truth);
  const auto position = [&](const Configuration& configuration, const char* name) {
    return joint_position(model.tree, configuration, joint_index(model.tree, name));
  };
  EXPECT_NEAR(position(result.configuration, "door"), 1.2, kRightHinge);
  EXPECT_NEAR(position(result.configuration, "drawer"), 0.12, 0.01);
}

TEST(HardScenes, ABlockOnAWallIsFoundBesideANearBox) {
  const ArticulatedModel& model = shipped("rigid_block");
  const Configuration truth = facing(model, 1.0, 0.0, 0.7);
  Scene scene = wall_behind(-box_around(model).min().z());
  scene.boxes.push_back(box_in(SceneFrame::world, {0.2, 0.25, 0.15}, {-0.3, 0.05, 0.75}));
  expect_found(first_answer(model, truth, scene), truth);
}

TEST(HardScenes, ABoxOfItsSizeIsNotTakenForABlockThatIsNotInView) {
  const ArticulatedModel& model = shipped("rigid_block");
  Configuration elsewhere = facing(model, 1.0, 0.0, 0.0);
  elsewhere.T_camera_base.pretranslate(Eigen::Vector3d(5.0, 0.0, 0.0));
  Scene scene;
  scene.planes.push_back({SceneFrame::world, {0.0, 0.0, 1.6}, {0.0, 0.0, -1.0}, {8.0, 8.0}});
  SceneBox box = box_in(SceneFrame::world, box_around(model).sizes(), {0.0, 0.0, 1.0});
  box.pose.rotate(Eigen::AngleAxisd(0.5, Eigen::Vector3d(1.0, 1.0, 0.2).normalized()));
  scene.boxes.push_back(box);
  EXPECT_NE(first_answer(model, elsewhere, scene).status, TrackingStatus::tracking);
}

/// Following an answer says nothing about its rivals: however often it is seen, an answer is not
/// trusted where it is wrong.
TEST(HardScenes, ABoxOfItsSizeBesideAHalfHiddenBlockIsNotTrustedWrongly) {
  const ArticulatedModel& model = shipped("rigid_block");
  const Configuration truth = facing(model, 1.1, 0.4, 0.3);
  const Eigen::AlignedBox3d block = box_around(model);
  Scene scene = wall_behind(0.5);
  scene.boxes.push_back(box_in(SceneFrame::world, block.sizes(), {0.35, 0.05, 1.1}));
  scene.boxes.push_back(box_in(SceneFrame::base, {0.5 * block.sizes().x(), 0.5, 0.02},
                               {0.5 * block.max().x(), 0.0, block.max().z() + 0.12}));
  Tracker tracker(model, {});
  for (std::uint64_t number = 0; number < 3; ++number) {
    expect_not_trusted_wrongly(tracker.process(seen_frame(model, truth, scene, number)), truth);
  }
}

TEST(HardScenes, OfWhichAStripIsInViewAreNotTrustedWrongly) {
  const ArticulatedModel& model = shipped("cabinet");
  for (const double side : {-1.0, 1.0}) {
    Configuration truth = facing(model, 1.2, 0.3, 0.0);
    const double edge = 0.5 * 640.0 / 575.8 * 1.2;  // metres from the axis to the image's edge
    const double half = 0.5 * box_around(model).sizes().x();
    truth.T_camera_base.pretranslate(Eigen::Vector3d(side * (edge + 0.7 * half), 0.0, 0.0));
    expect_not_trusted_wrongly(first_answer(model, truth, wall_behind(0.8)), truth);
  }
}

}  // namespace
}  // namespace lockbox
