// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/simulation/simulator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "lockbox/core/error.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/simulation/trajectory.hpp"
#include "small_models.hpp"

namespace lockbox {
namespace {

const PinholeCamera kHalfCamera{320, 240, 287.9, 287.9, 159.5, 119.5};

State start_of(const KinematicTree& tree) {
  return generate_trajectory(tree, {.frames = 1})[0];
}

PlacedScene wall_behind(const State& state) {
  Scene scene;
  ScenePlane wall;
  wall.point = {0.0, 0.0, 2.0};
  scene.planes.push_back(wall);
  return {scene, {state}};
}

TEST(Simulator, ShowsTheModelBeforeTheBackground) {
  const KinematicTree tree = testing::board_with_three_joints();
  const State state = start_of(tree);
  Simulator simulator(tree, kHalfCamera, wall_behind(state), sensor_model("ideal"), 1, Executor(2));
  DepthFrame frame;
  simulator.simulate(state, 4, frame);
  EXPECT_EQ(frame.index, 4U);
  EXPECT_EQ(frame.stamp, state.stamp);
  // The board's front is 1 cm before the base frame at 1.3 m; the door lies over its middle left.
  EXPECT_NEAR(frame.metres(160, 100), 1.29, 1e-6);
  EXPECT_NEAR(frame.metres(5, 120), 2.0, 1e-6);
  EXPECT_EQ(simulator.clean().id[120 * 320 + 5], kBackgroundId);
  EXPECT_EQ(simulator.clean().id[100 * 320 + 160], 0);
}

TEST(Simulator, JointsMoveTheirBodies) {
  const KinematicTree tree = testing::board_with_three_joints();
  State state = start_of(tree);
  Simulator simulator(tree, kHalfCamera, PlacedScene(), sensor_model("ideal"), 1, Executor(2));
  DepthFrame frame;
  // The slider's front lies 0.05 + 0.02 m before the base frame, its centre at (0.1, -0.1).
  const auto pixel = [](double x, double y, double z) {
    return kHalfCamera.project({x, -y, 1.3 - z});
  };
  for (const double q : {-0.1, 0.0, 0.2}) {
    state.configuration.q[1] = q;
    simulator.simulate(state, 0, frame);
    const Eigen::Vector2d centre = pixel(0.1 + q, -0.1, 0.07);
    EXPECT_NEAR(frame.metres(static_cast<int>(centre.x()), static_cast<int>(centre.y())), 1.23,
                1e-6);
  }
}

TEST(Simulator, SameForAnyNumberOfThreads) {
  const KinematicTree tree = testing::board_with_three_joints();
  const auto run = generate_trajectory(tree, {.frames = 5, .rate = 1.0});
  const auto frames = [&](int threads) {
    Simulator simulator(tree, kHalfCamera, wall_behind(run[0]), sensor_model("primesense"), 3,
                        Executor(threads));
    std::vector<std::vector<std::uint16_t>> depths;
    for (std::size_t i = 0; i < run.size(); ++i) {
      DepthFrame frame;
      simulator.simulate(run[i], i, frame);
      depths.push_back(frame.depth);
    }
    return depths;
  };
  const auto reference = frames(1);
  for (const int threads : {2, 3, 8}) {
    EXPECT_EQ(frames(threads), reference) << threads;
  }
}

TEST(Simulator, StateThatIsNotCompleteIsRefused) {
  const KinematicTree tree = testing::board_with_three_joints();
  Simulator simulator(tree, kHalfCamera, PlacedScene(), sensor_model("ideal"), 1, Executor(1));
  DepthFrame frame;
  State unknown = start_of(tree);
  unknown.known = false;
  EXPECT_THROW(simulator.simulate(unknown, 0, frame), InputError);
  State joint_missing = start_of(tree);
  joint_missing.configuration.q[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(simulator.simulate(joint_missing, 0, frame), InputError);
}

// The scene promises: in the middle third, up to half of the box, never nearer to it than 5 cm.
TEST(ShippedScene, ArmPassesBeforeTheLockboxWithoutTouchingIt) {
  const std::string share = LOCKBOX_SHARE_DIRECTORY;
  const KinematicTree tree = load_kinematic_tree(share + "/models/lockbox/lockbox.urdf");
  const auto run = generate_trajectory(tree, {.frames = 91, .rate = 10.0});
  const PlacedScene scene(read_scene(share + "/scenes/room_with_arm.yaml"), run);
  Simulator with_arm(tree, kHalfCamera, scene, sensor_model("ideal"), 1, Executor(2));
  Simulator alone(tree, kHalfCamera, PlacedScene(), sensor_model("ideal"), 1, Executor(2));
  DepthFrame frame;
  double most_hidden = 0.0;
  for (std::size_t i = 0; i < run.size(); i += 3) {
    with_arm.simulate(run[i], i, frame);
    alone.simulate(run[i], i, frame);
    int visible = 0;
    int hidden = 0;
    for (std::size_t k = 0; k < alone.clean().id.size(); ++k) {
      if (alone.clean().id[k] == kNothing) continue;
      ++visible;
      if (with_arm.clean().id[k] == kOccluderId) {
        ++hidden;
        ASSERT_GT(alone.clean().depth[k] - with_arm.clean().depth[k], 0.05F) << i;
      }
    }
    if (i < run.size() / 3 || i > 2 * run.size() / 3 + 1) {
      EXPECT_EQ(hidden, 0) << i;
    }
    most_hidden = std::max(most_hidden, static_cast<double>(hidden) / visible);
  }
  EXPECT_GT(most_hidden, 0.35);
  EXPECT_LT(most_hidden, 0.55);
}

}  // namespace
}  // namespace lockbox
