// SPDX-License-Identifier: BSD-3-Clause
// Property "the solver is a solver": a linear problem in one undamped step, limits as active
// bounds, no step without information; a hidden joint stays where it is and nothing visible
// freezes.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <random>
#include <utility>

#include "initialization/seen_model.hpp"
#include "lockbox/simulation/trajectory.hpp"
#include "lockbox/solver/bounded_step.hpp"
#include "lockbox/tracking/tracker.hpp"
#include "registration/mechanism.hpp"

namespace lockbox {
namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

NormalEquations random_equations(int n, std::mt19937& random) {
  std::normal_distribution<double> normal;
  Eigen::MatrixXd A(n + 2, n);
  NormalEquations equations;
  equations.gradient.resize(n);
  for (Eigen::Index i = 0; i < A.size(); ++i) {
    A.data()[i] = normal(random);
  }
  for (int i = 0; i < n; ++i) {
    equations.gradient[i] = normal(random);
  }
  equations.hessian = A.transpose() * A;
  equations.information = equations.hessian;
  return equations;
}

StepLimits no_limits(int n) {
  return {Eigen::VectorXd::Constant(n, -kUnlimited), Eigen::VectorXd::Constant(n, kUnlimited)};
}

StepScale unit_scale(int n) {
  return {Eigen::VectorXd::Ones(n), 1e-12};
}

Eigen::VectorXd solve(const NormalEquations& equations, double damping, const StepLimits& limits,
                      const StepScale& scale) {
  return BoundedStepSolver().solve(equations, damping, limits, scale);
}

double quadratic(const NormalEquations& equations, const Eigen::VectorXd& s) {
  return equations.gradient.dot(s) + 0.5 * s.dot(equations.hessian * s);
}

TEST(BoundedStep, CanBeMovedBeforeItHasSolvedAnything) {
  // In memory that is not zero, where members left unset have values that their types do not know.
  alignas(BoundedStepSolver) std::array<std::byte, sizeof(BoundedStepSolver)> memory{};
  memory.fill(std::byte{0xBE});
  auto* const fresh = new (memory.data()) BoundedStepSolver;
  BoundedStepSolver moved(std::move(*fresh));
  std::destroy_at(fresh);
  std::mt19937 random(1);
  EXPECT_TRUE(
      moved.solve(random_equations(3, random), 0.0, no_limits(3), unit_scale(3)).allFinite());
}

TEST(BoundedStep, SolvesLinearProblemExactlyWithoutDamping) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 50; ++trial) {
    const NormalEquations equations = random_equations(9, random);
    const Eigen::VectorXd step = solve(equations, 0.0, no_limits(9), unit_scale(9));
    EXPECT_LT((equations.hessian * step + equations.gradient).norm(), 1e-8);
  }
}

TEST(BoundedStep, ActiveLimitsReachTheConstrainedOptimumOfABruteForceSearch) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> size(0.0, 0.4);
  for (int trial = 0; trial < 200; ++trial) {
    const int n = 3;
    const NormalEquations equations = random_equations(n, random);
    StepLimits limits = no_limits(n);
    for (int i = 0; i < n; ++i) {
      limits.lower[i] = -size(random);
      limits.upper[i] = size(random);
    }
    const Eigen::VectorXd step = solve(equations, 0.0, limits, unit_scale(n));
    const double reached = quadratic(equations, step);
    constexpr int kGrid = 40;
    for (int k = 0; k < kGrid * kGrid * kGrid; ++k) {
      Eigen::VectorXd s(n);
      for (int i = 0, rest = k; i < n; ++i, rest /= kGrid) {
        s[i] = limits.lower[i] + (limits.upper[i] - limits.lower[i]) * (rest % kGrid) / (kGrid - 1);
      }
      ASSERT_LE(reached, quadratic(equations, s) + 1e-9) << "trial " << trial;
    }
    EXPECT_TRUE((step.array() >= limits.lower.array() - 1e-12).all());
    EXPECT_TRUE((step.array() <= limits.upper.array() + 1e-12).all());
  }
}

TEST(BoundedStep, HeldUnknownsDoNotMove) {
  std::mt19937 random(3);
  const NormalEquations equations = random_equations(6, random);
  StepLimits limits = no_limits(6);
  limits.lower[2] = limits.upper[2] = 0.0;
  limits.lower[5] = limits.upper[5] = 0.0;
  const Eigen::VectorXd step = solve(equations, 0.0, limits, unit_scale(6));
  EXPECT_EQ(step[2], 0.0);
  EXPECT_EQ(step[5], 0.0);
  EXPECT_GT(step.norm(), 0.0);
}

TEST(BoundedStep, DirectionsWithoutInformationAreLeftAlone) {
  // x + y is measured, x - y is not.
  NormalEquations equations;
  equations.hessian = Eigen::Matrix2d::Ones() * 100.0;
  equations.information = equations.hessian;
  equations.gradient = Eigen::Vector2d(30.0, 30.0);
  StepScale scale = unit_scale(2);
  scale.least_information = 1.0;
  const Eigen::VectorXd step = solve(equations, 0.0, no_limits(2), scale);
  EXPECT_NEAR(step[0], -0.15, 1e-12);
  EXPECT_NEAR(step[1], -0.15, 1e-12);
}

TEST(BoundedStep, UnitsDecideWhatCountsAsInformation) {
  NormalEquations equations;
  equations.hessian = Eigen::Matrix2d::Identity() * 100.0;
  equations.information = equations.hessian;
  equations.gradient = Eigen::Vector2d(-10.0, -10.0);
  StepScale scale{Eigen::Vector2d(1.0, 0.05), 1.0};  // 100 * 0.05^2 = 0.25 < 1
  const Eigen::VectorXd step = solve(equations, 0.0, no_limits(2), scale);
  EXPECT_NEAR(step[0], 0.1, 1e-12);
  EXPECT_EQ(step[1], 0.0);
}

TEST(BoundedStep, DampingShortensTheStep) {
  std::mt19937 random(4);
  const NormalEquations equations = random_equations(5, random);
  const double free = solve(equations, 0.0, no_limits(5), unit_scale(5)).norm();
  const double damped = solve(equations, 10.0, no_limits(5), unit_scale(5)).norm();
  EXPECT_LT(damped, free);
}

/// A plate with a block that slides in sight, and a handle that turns behind a box 5 cm before it.
class StillFrames : public ::testing::Test {
 protected:
  static constexpr int kFrames = 1000;
  const ArticulatedModel model_ = load_mechanism(
      {R"(<link name="plate"><visual><geometry><box size="0.36 0.26 0.02"/></geometry></visual>
          </link>)",
       R"(<link name="block"><visual><geometry><box size="0.08 0.08 0.06"/></geometry></visual>
          </link>)",
       R"(<link name="handle"><visual><geometry><box size="0.07 0.02 0.03"/></geometry></visual>
          </link>)",
       R"(<joint name="slide" type="prismatic"><parent link="plate"/><child link="block"/>
          <origin xyz="-0.09 0 0.04"/><axis xyz="0 1 0"/>
          <limit lower="-0.2" upper="0.2" effort="1" velocity="1"/></joint>)",
       R"(<joint name="turn" type="continuous"><parent link="plate"/><child link="handle"/>
          <origin xyz="0.1 0 0.025"/><axis xyz="0 0 1"/></joint>)"},
      with_cache());
  const int slide_ = variable("slide");
  const int turn_ = variable("turn");
  const PinholeCamera camera_{160, 120, 250.0, 250.0, 79.5, 59.5};
  Configuration truth_ = [this] {
    Configuration configuration = rest_configuration(model_.tree);
    configuration.T_camera_base =
        facing_pose(0.6) * Eigen::AngleAxisd(0.25, Eigen::Vector3d(1.0, 1.0, 0.0).normalized());
    configuration.q[turn_] = 0.5;
    return configuration;
  }();

  int variable(const std::string& joint) const {
    return model_.tree.joints[static_cast<std::size_t>(joint_index(model_.tree, joint))].variable;
  }

  State state(int frame) const {
    State result;
    result.stamp = frame / 30.0;
    result.configuration = truth_;
    return result;
  }

  Scene scene() const {
    Scene scene = wall_behind(0.5);
    SceneBox cover;
    cover.frame = SceneFrame::base;
    cover.size = {0.16, 0.18, 0.02};
    cover.pose.translation() = Eigen::Vector3d(0.1, 0.0, 0.1);
    scene.boxes.push_back(cover);
    return scene;
  }
};

TEST_F(StillFrames, AHiddenJointStaysAndNothingVisibleFreezes) {
  Simulator simulator(model_.tree, camera_, PlacedScene(scene(), {state(0)}), sensor_model("white"),
                      5, Executor(1));
  TrackerOptions options;
  options.threads = 1;
  options.search_anywhere = false;
  Tracker tracker(model_, options);
  tracker.start(truth_);
  DepthFrame frame;
  Eigen::VectorXd lowest;
  Eigen::VectorXd highest;
  for (int k = 0; k < kFrames; ++k) {
    simulator.simulate(state(k), static_cast<std::uint64_t>(k), frame);
    const TrackingResult& result = tracker.process(frame);
    ASSERT_EQ(result.status, TrackingStatus::tracking) << "frame " << k;
    if (k == 0) {
      lowest = highest = result.configuration.q;
      continue;
    }
    EXPECT_TRUE(result.observable[static_cast<std::size_t>(unknown_of(slide_))]) << "frame " << k;
    EXPECT_FALSE(result.observable[static_cast<std::size_t>(unknown_of(turn_))]) << "frame " << k;
    lowest = lowest.cwiseMin(result.configuration.q);
    highest = highest.cwiseMax(result.configuration.q);
  }
  EXPECT_LT(highest[turn_] - lowest[turn_], 1e-6);
  EXPECT_GT(highest[slide_] - lowest[slide_], 1e-5) << "frozen";
  EXPECT_GE(highest[slide_], truth_.q[slide_] - 5e-4);
  EXPECT_LE(lowest[slide_], truth_.q[slide_] + 5e-4);
  // What moves at last is followed.
  truth_.q[slide_] += 0.006;
  Configuration found;
  for (int k = kFrames; k < kFrames + 4; ++k) {
    simulator.simulate(state(k), static_cast<std::uint64_t>(k), frame);
    found = tracker.process(frame).configuration;
  }
  EXPECT_NEAR(found.q[slide_], truth_.q[slide_], 3e-3);
}

}  // namespace
}  // namespace lockbox
