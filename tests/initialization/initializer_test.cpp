// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/initialization/initializer.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "lockbox/core/error.hpp"
#include "lockbox/simulation/trajectory.hpp"
#include "registration/mechanism.hpp"
#include "seen_model.hpp"

namespace lockbox {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

void expect_base(const Configuration& found, const Configuration& truth) {
  const Eigen::Isometry3d error = found.T_camera_base.inverse() * truth.T_camera_base;
  EXPECT_LT(error.translation().norm(), 0.01);
  EXPECT_LT(Eigen::AngleAxisd(error.linear()).angle(), kDegree);
}

std::vector<Candidate> search(const ArticulatedModel& model, const TiledCloud& cloud,
                              int threads = 0) {
  return Initializer(model, {}, Executor(threads)).find(cloud);
}

TEST(Initializer, FindsTheLockboxAndAllItsJoints) {
  const ArticulatedModel& model = shipped("lockbox");
  Configuration truth = facing(model, 1.3, 0.4, 2.0);
  set_joint_position(model.tree, truth, "door_light_blue", 1.2);
  set_joint_position(model.tree, truth, "disk", 2.5);
  set_joint_position(model.tree, truth, "block", 0.13);
  set_joint_position(model.tree, truth, "slider", 0.08);
  const auto found = search(model, seen(model, truth, wall_behind(0.8)));
  ASSERT_FALSE(found.empty());
  const Configuration& best = found.front().configuration;
  expect_base(best, truth);
  for (const std::string joint : {"door_light_blue", "disk", "block", "slider", "latch"}) {
    const int index = joint_index(model.tree, joint);
    EXPECT_NEAR(joint_position(model.tree, best, index), joint_position(model.tree, truth, index),
                model.tree.joints[static_cast<std::size_t>(index)].type == JointType::prismatic
                    ? 0.01
                    : 5.0 * kDegree)
        << joint;
  }
  EXPECT_GT(found.front().agreement.explained, 0.9);
}

/// Turned over, the plate would fit as well, and its own parts could stand before it by chance.
TEST(Initializer, TellsTheFrontOfAPlateByTheSmallPartsOnIt) {
  const ArticulatedModel& model = mechanism();
  Configuration truth = mechanism_start(model);
  truth.T_camera_base.pretranslate(Eigen::Vector3d(0.0, 0.0, 0.1));
  const auto found = search(model, cloud_of(measured(model, truth, "primesense", 1)));
  ASSERT_FALSE(found.empty());
  expect_base(found.front().configuration, truth);
}

TEST(Initializer, TellsTheBoardFromTheWallItHangsOn) {
  const ArticulatedModel& model = shipped("lockbox");
  const Configuration truth = facing(model, 1.5, -0.5, -0.7);
  const auto found = search(model, seen(model, truth, wall_behind(0.018)));
  ASSERT_FALSE(found.empty());
  expect_base(found.front().configuration, truth);
}

TEST(Initializer, FindsABoxThatIsPartlyOutsideTheImage) {
  const ArticulatedModel& model = shipped("lockbox");
  Configuration truth = facing(model, 1.1, 0.2, 0.3);
  truth.T_camera_base.pretranslate(Eigen::Vector3d(0.45, 0.1, 0.0));
  const auto found = search(model, seen(model, truth, wall_behind(0.6)));
  ASSERT_FALSE(found.empty());
  expect_base(found.front().configuration, truth);
}

TEST(Initializer, FindsASmallRigidBlock) {
  const ArticulatedModel& model = shipped("rigid_block");
  const Configuration truth = facing(model, 1.0, 0.5, 1.0);
  const auto found = search(model, seen(model, truth, wall_behind(0.5)));
  ASSERT_FALSE(found.empty());
  expect_base(found.front().configuration, truth);
}

TEST(Initializer, RanksItsAnswersByScore) {
  const ArticulatedModel& model = shipped("rigid_block");
  const auto found = search(model, seen(model, facing(model, 1.0, 0.5, 1.0), wall_behind(0.5)));
  for (std::size_t i = 1; i < found.size(); ++i)
    EXPECT_LE(found[i].evidence, found[i - 1].evidence);
}

TEST(Initializer, FindsNothingWhereNothingIsMeasured) {
  DepthFrame frame;
  frame.camera = {64, 48, 57.6, 57.6, 31.5, 23.5};
  frame.depth.assign(64 * 48, 0);
  TiledCloud cloud;
  cloud.assign(frame, {}, Executor(1));
  EXPECT_TRUE(search(shipped("rigid_block"), cloud, 1).empty());
}

TEST(Initializer, RefusesACloudWithoutImage) {
  EXPECT_THROW(search(shipped("rigid_block"), TiledCloud(), 1), InputError);
}

}  // namespace
}  // namespace lockbox
