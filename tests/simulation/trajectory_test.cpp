// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/simulation/trajectory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "lockbox/core/lie.hpp"
#include "lockbox/mesh/primitives.hpp"
#include "small_models.hpp"

namespace lockbox {
namespace {

std::vector<double> positions(const std::vector<State>& states, int variable) {
  std::vector<double> q;
  for (const State& state : states) {
    q.push_back(state.configuration.q[variable]);
  }
  return q;
}

TEST(Trajectory, HasTheFramesAndTheRateAskedFor) {
  const KinematicTree tree = testing::board_with_three_joints();
  const auto states = generate_trajectory(tree, {.frames = 31, .rate = 10.0});
  ASSERT_EQ(states.size(), 31U);
  EXPECT_DOUBLE_EQ(states.front().stamp, 0.0);
  EXPECT_DOUBLE_EQ(states.back().stamp, 3.0);
}

TEST(Trajectory, EveryJointPassesItsShareOfTheRangeAndStaysWithin) {
  const KinematicTree tree = testing::board_with_three_joints();
  const auto states = generate_trajectory(tree);
  for (int v = 0; v < tree.variables(); ++v) {
    const auto q = positions(states, v);
    const auto [low, high] = std::minmax_element(q.begin(), q.end());
    const VariableLimits limits = variable_limits(tree, v);
    EXPECT_GE(*low, limits.lower) << v;
    EXPECT_LE(*high, limits.upper) << v;
    const double range =
        std::isfinite(limits.upper) ? limits.upper - limits.lower : 2.0 * std::numbers::pi;
    EXPECT_GE(*high - *low, 0.88 * range) << v;
  }
}

TEST(Trajectory, StartsAndEndsAtRest) {
  const KinematicTree tree = testing::board_with_three_joints();
  const auto states = generate_trajectory(tree);
  const Configuration rest = rest_configuration(tree);
  EXPECT_EQ(states.front().configuration.q, rest.q);
  EXPECT_LT((states.back().configuration.q - rest.q).norm(), 1e-12);
  EXPECT_TRUE(states.front().configuration.T_camera_base.isApprox(facing_pose(1.3)));
  const Twist first_step = log_se3(states[0].configuration.T_camera_base.inverse() *
                                   states[1].configuration.T_camera_base);
  EXPECT_LT(first_step.norm(), 1e-4);
}

TEST(Trajectory, MovesSmoothly) {
  const KinematicTree tree = testing::board_with_three_joints();
  const auto states = generate_trajectory(tree, {.frames = 600});
  for (int v = 0; v < tree.variables(); ++v) {
    const auto q = positions(states, v);
    double largest_step = 0.0;
    for (std::size_t i = 1; i < q.size(); ++i) {
      largest_step = std::max(largest_step, std::abs(q[i] - q[i - 1]));
    }
    for (std::size_t i = 2; i < q.size(); ++i) {
      EXPECT_LT(std::abs(q[i] - 2.0 * q[i - 1] + q[i - 2]), 0.1 * largest_step) << v << " " << i;
    }
  }
}

TEST(Trajectory, JointsMoveAtTimesOfTheirOwn) {
  const KinematicTree tree = testing::board_with_three_joints();
  const auto states = generate_trajectory(tree);
  std::set<std::ptrdiff_t> frames_of_extremes;
  for (int v = 0; v < tree.variables(); ++v) {
    const auto q = positions(states, v);
    frames_of_extremes.insert(std::max_element(q.begin(), q.end()) - q.begin());
  }
  EXPECT_EQ(frames_of_extremes.size(), 3U);
}

TEST(Trajectory, JointsWaitForEachOtherWhereTheWayIsBlocked) {
  const KinematicTree tree = testing::board_with_three_joints();
  const Configuration rest = rest_configuration(tree);
  const auto share = [&](const Configuration& configuration, int v) {
    const VariableLimits limits = variable_limits(tree, v);
    const double range = std::isfinite(limits.upper) ? limits.upper - limits.lower : 2.0;
    return std::abs(configuration.q[v] - rest.q[v]) / range;
  };
  // As a drawer behind a door: only one of the two may be away from rest, but for a little.
  TrajectoryOptions options;
  options.is_possible = [&](const Configuration& configuration) {
    return std::min(share(configuration, 0), share(configuration, 1)) < 0.1;
  };
  const auto states = generate_trajectory(tree, options);
  for (const State& state : states) {
    EXPECT_TRUE(options.is_possible(state.configuration)) << state.stamp;
  }
  EXPECT_LT((states.back().configuration.q - rest.q).norm(), 1e-12);
  for (int v = 0; v < tree.variables(); ++v) {
    EXPECT_TRUE(std::any_of(states.begin(), states.end(), [&](const State& state) {
      return share(state.configuration, v) > 0.4;
    })) << v;
  }
}

TEST(Trajectory, EndsThoughNothingIsPossible) {
  const KinematicTree tree = testing::board_with_three_joints();
  TrajectoryOptions options;
  options.is_possible = [](const Configuration&) { return false; };
  const auto states = generate_trajectory(tree, options);
  EXPECT_LT((states.back().configuration.q - rest_configuration(tree).q).norm(), 1e-12);
}

/// Of a cube with such sides.
double distance_for(double side) {
  KinematicTree tree;
  tree.bodies.emplace_back();
  tree.bodies.front().mesh = make_box(Eigen::Vector3d::Constant(side));
  return viewing_distance(tree, {640, 480, 575.8, 575.8, 319.5, 239.5});
}

TEST(Trajectory, WhatIsSmallIsLookedAtFromNearByAndWhatIsLargeFromAfar) {
  EXPECT_DOUBLE_EQ(distance_for(0.4), 1.3);
  EXPECT_NEAR(distance_for(0.1), 4.5 * 0.1 * std::sqrt(3.0), 1e-9);
  EXPECT_DOUBLE_EQ(distance_for(0.02), 0.5) << "a depth sensor sees nothing nearer";
  const double far = distance_for(2.4);
  EXPECT_GT(480.0 * far / 575.8, 2.4) << "the image is as high as that";
}

TEST(Trajectory, CameraMovesByTheAmplitudesAskedFor) {
  const KinematicTree tree = testing::board_with_three_joints();
  const auto still = generate_trajectory(tree, {.sway = 0.0, .turn = 0.0});
  for (const State& state : still) {
    EXPECT_TRUE(state.configuration.T_camera_base.isApprox(facing_pose(1.3)));
  }
  double farthest = 0.0;
  for (const State& state : generate_trajectory(tree, {.frames = 600, .sway = 0.05, .turn = 0.0})) {
    const Eigen::Vector3d way =
        state.configuration.T_camera_base.translation() - facing_pose(1.3).translation();
    farthest = std::max(farthest, way.cwiseAbs().maxCoeff());
  }
  EXPECT_NEAR(farthest, 0.05, 0.002);
}

TEST(Trajectory, ModelWithoutJointsIsLegal) {
  KinematicTree tree;
  tree.bodies = {testing::box_body("block", {0.2, 0.2, 0.2}, -1)};
  EXPECT_EQ(generate_trajectory(tree, {.frames = 5}).size(), 5U);
}

}  // namespace
}  // namespace lockbox
