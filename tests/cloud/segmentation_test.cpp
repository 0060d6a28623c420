// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/cloud/segmentation.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "lockbox/core/error.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/simulation/simulator.hpp"
#include "lockbox/simulation/trajectory.hpp"

namespace lockbox {
namespace {

const PinholeCamera kSensor{640, 480, 575.8, 575.8, 319.5, 239.5};
constexpr double kMargin = 0.2;

const KinematicTree& shipped_lockbox() {
  static const KinematicTree tree =
      load_kinematic_tree(LOCKBOX_SHARE_DIRECTORY "/models/lockbox/lockbox.urdf");
  return tree;
}

Scene shipped_scene(const std::string& name) {
  return read_scene(LOCKBOX_SHARE_DIRECTORY "/scenes/" + name + ".yaml");
}

/// A measured frame and what each of its pixels really shows.
struct View {
  TiledCloud cloud;
  std::vector<std::int16_t> id;
};

View view_of(const Scene& scene, const State& state) {
  Simulator simulator(shipped_lockbox(), kSensor, {scene, {state}}, sensor_model("primesense"), 7,
                      Executor(2));
  DepthFrame frame;
  simulator.simulate(state, 0, frame);
  View view;
  view.cloud.assign(frame, {}, Executor(2));
  // refined(camera, 2): every second sample is a pixel's centre.
  const int factor = simulator.sample_camera().width == kSensor.width ? 1 : 2;
  for (int v = 0; v < kSensor.height; ++v) {
    for (int u = 0; u < kSensor.width; ++u) {
      const int sample = factor * v * simulator.sample_camera().width + factor * u;
      view.id.push_back(simulator.clean().id[static_cast<std::size_t>(sample)]);
    }
  }
  return view;
}

std::vector<ExpectedBody> expected_at(const Configuration& configuration) {
  const KinematicTree& tree = shipped_lockbox();
  std::vector<Eigen::Isometry3d> poses;
  forward_kinematics(tree, configuration, poses);
  std::vector<ExpectedBody> expected(tree.bodies.size());
  for (std::size_t b = 0; b < expected.size(); ++b) {
    expected[b].T_camera_body = poses[b];
    expected[b].box = bounds(tree.bodies[b].mesh);
  }
  return expected;
}

/// 8 cm and 8 degrees away.
Configuration displaced(Configuration configuration, const Eigen::Vector3d& shift,
                        const Eigen::Vector3d& axis) {
  configuration.T_camera_base.translation() += 0.08 * shift.normalized();
  configuration.T_camera_base.rotate(
      Eigen::AngleAxisd(8.0 / 180.0 * std::numbers::pi, axis.normalized()));
  return configuration;
}

struct Shares {
  double object_kept = 0.0;
  double scene_removed = 0.0;
};

Shares shares_of(const View& view, const std::vector<std::uint8_t>& mask) {
  double object = 0.0;
  double object_kept = 0.0;
  double scene = 0.0;
  double scene_removed = 0.0;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (view.cloud.depth()[i] == 0.0F) {
      continue;
    }
    if (view.id[i] >= kBackgroundId) {
      scene += 1.0;
      scene_removed += mask[i] == 0 ? 1.0 : 0.0;
    } else if (view.id[i] >= 0) {
      object += 1.0;
      object_kept += mask[i];
    }
  }
  return {object_kept / object, scene > 0.0 ? scene_removed / scene : 1.0};
}

/// The lockbox at that distance, seen from its front or from 20 degrees beside and above it, some
/// way into a run in which all of its joints move.
State state_at(double distance, bool oblique) {
  TrajectoryOptions options;
  options.frames = 13;
  options.T_camera_base = facing_pose(distance);
  if (oblique) {
    options.T_camera_base.rotate(
        Eigen::AngleAxisd(0.35, Eigen::Vector3d(0.7, -0.5, 0.1).normalized()));
  }
  return generate_trajectory(shipped_lockbox(), options)[5];
}

const std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> kShiftsAndAxes{
    {{1, 1, 1}, {1, 2, 3}},
    {{-1, 0, -1}, {0, 1, 0}},
    {{0, -1, 0}, {0, 0, 1}},
    {{0, 0, 1}, {1, 0, 0}}};

void expect_separated(const Scene& scene, double distance, bool oblique) {
  const State state = state_at(distance, oblique);
  const View view = view_of(scene, state);
  for (const auto& [shift, axis] : kShiftsAndAxes) {
    const auto expected = expected_at(displaced(state.configuration, shift, axis));
    const auto mask = ObjectSegmenter().segment(view.cloud, expected, kMargin);
    ASSERT_TRUE(mask.has_value());
    const Shares shares = shares_of(view, *mask);
    EXPECT_GE(shares.object_kept, 0.95) << "shifted by " << shift.transpose();
    EXPECT_GE(shares.scene_removed, 0.90) << "shifted by " << shift.transpose();
  }
}

Scene wall_and_floor() {
  Scene scene = shipped_scene("room");
  scene.boxes.clear();
  return scene;
}

class Separation : public ::testing::TestWithParam<bool> {};

TEST_P(Separation, OfAnObjectWithNothingAround) {
  expect_separated(Scene(), 1.3, GetParam());
}

TEST_P(Separation, FromAWallFarBehind) {
  expect_separated(wall_and_floor(), 1.3, GetParam());
}

TEST_P(Separation, FromTheTableThatItStandsOn) {
  expect_separated(shipped_scene("room"), 1.4, GetParam());
}

TEST_P(Separation, FromTheWallThatItsBackTouches) {
  expect_separated(shipped_scene("flush_wall"), 1.3, GetParam());
}

TEST_P(Separation, FromTheWallThatItsBackTouchesFarther) {
  expect_separated(shipped_scene("flush_wall"), 1.6, GetParam());
}

INSTANTIATE_TEST_SUITE_P(SeenFrom, Separation, ::testing::Bool(),
                         [](const auto& view) { return view.param ? "TheSide" : "TheFront"; });

TEST(ObjectSegmenter, FindsNothingWhereNoObjectIs) {
  const State state = state_at(1.3, false);
  const View view = view_of(wall_and_floor(), state);
  Configuration elsewhere = state.configuration;
  elsewhere.T_camera_base.translation().z() -= 0.6;
  EXPECT_FALSE(ObjectSegmenter().segment(view.cloud, expected_at(elsewhere), 0.1).has_value());
  EXPECT_FALSE(ObjectSegmenter().segment(view.cloud, {}, 0.1).has_value());
  EXPECT_FALSE(ObjectSegmenter().segment(TiledCloud(), expected_at(elsewhere), 0.1).has_value());
}

TEST(ObjectSegmenter, FindsNothingInAFrameWithoutMeasurements) {
  DepthFrame frame;
  frame.camera = kSensor;
  frame.depth.assign(640 * 480, 0);
  TiledCloud cloud;
  cloud.assign(frame, {}, Executor(1));
  const auto expected = expected_at(state_at(1.3, false).configuration);
  EXPECT_FALSE(ObjectSegmenter().segment(cloud, expected, kMargin).has_value());
}

TEST(ObjectSegmenter, GivesTheSameMaskEachTime) {
  const State state = state_at(1.3, true);
  const View view = view_of(shipped_scene("flush_wall"), state);
  const auto expected = expected_at(state.configuration);
  const auto first = ObjectSegmenter().segment(view.cloud, expected, kMargin);
  ASSERT_TRUE(first.has_value());
  EXPECT_EQ(ObjectSegmenter().segment(view.cloud, expected, kMargin), first);
}

TEST(ObjectSegmenter, LeavesTheConsoleAlone) {
  const State state = state_at(1.3, true);
  const View view = view_of(shipped_scene("room"), state);
  ::testing::internal::CaptureStderr();
  ::testing::internal::CaptureStdout();
  ObjectSegmenter().segment(view.cloud, expected_at(state.configuration), kMargin);
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(ObjectSegmenter, WorksOnSmallImages) {
  for (const auto& [width, height] : {std::pair{1, 1}, {3, 2}, {7, 200}, {200, 2}}) {
    DepthFrame frame;
    frame.camera = {width, height, 100.0, 100.0, 0.5 * (width - 1), 0.5 * (height - 1)};
    frame.depth.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 1300);
    TiledCloud cloud;
    cloud.assign(frame, {}, Executor(1));
    const auto expected = expected_at(state_at(1.3, false).configuration);
    const auto mask = ObjectSegmenter().segment(cloud, expected, kMargin);
    EXPECT_TRUE(!mask || mask->size() == frame.depth.size());
  }
}

TEST(ObjectSegmenter, RefusesExpectationsThatAreNoNumbers) {
  const View view = view_of(Scene(), state_at(1.3, false));
  auto expected = expected_at(state_at(1.3, false).configuration);
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(ObjectSegmenter().segment(view.cloud, expected, kNan), InputError);
  expected[0].T_camera_body.translation().x() = kNan;
  EXPECT_THROW(ObjectSegmenter().segment(view.cloud, expected, kMargin), InputError);
}

}  // namespace
}  // namespace lockbox
