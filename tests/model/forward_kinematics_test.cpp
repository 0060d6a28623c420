// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/model/forward_kinematics.hpp"

#include <gtest/gtest.h>

#include <array>
#include <numbers>

#include "chains.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/model/moved_bodies.hpp"
#include "lockbox/model/variable_range.hpp"

namespace lockbox {
namespace {

constexpr double kHalfPi = std::numbers::pi / 2.0;

Configuration random_configuration(const KinematicTree& tree, std::mt19937& generator) {
  Configuration configuration;
  configuration.T_camera_base = random_pose(generator);
  configuration.q = Eigen::VectorXd::Zero(tree.variables());
  for (double& q : configuration.q) q = random_vector(generator).x();
  return configuration;
}

std::vector<Eigen::Isometry3d> poses(const KinematicTree& tree,
                                     const Configuration& configuration) {
  std::vector<Eigen::Isometry3d> T_camera_body;
  forward_kinematics(tree, configuration, T_camera_body);
  return T_camera_body;
}

/// Central differences of a twist that is zero at the given configuration.
template <typename TwistOf>
BodyJacobian numerical_jacobian(const KinematicTree& tree, const Configuration& configuration,
                                const TwistOf& twist_of) {
  constexpr double kStep = 1e-5;
  BodyJacobian jacobian(6, tree.unknowns());
  for (Eigen::Index k = 0; k < jacobian.cols(); ++k) {
    const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(jacobian.cols(), k);
    jacobian.col(k) = (twist_of(poses(tree, stepped(configuration, step))) -
                       twist_of(poses(tree, stepped(configuration, -step)))) /
                      (2.0 * kStep);
  }
  return jacobian;
}

void expect_exact_body_jacobians(const KinematicTree& tree, const Configuration& configuration) {
  const auto T_camera_body = poses(tree, configuration);
  std::vector<BodyJacobian> jacobians;
  body_jacobians(tree, T_camera_body, jacobians);
  for (std::size_t b = 0; b < tree.bodies.size(); ++b) {
    const auto numerical = numerical_jacobian(tree, configuration, [&](const auto& moved) {
      return log_se3(T_camera_body[b].inverse() * moved[b]);
    });
    EXPECT_LT((jacobians[b] - numerical).cwiseAbs().maxCoeff(), 1e-8) << "body " << b;
  }
}

void expect_exact_relative_jacobian(const KinematicTree& tree, const Configuration& configuration,
                                    std::size_t a, std::size_t b) {
  const auto T_camera_body = poses(tree, configuration);
  const Eigen::Isometry3d T_b_a = T_camera_body[b].inverse() * T_camera_body[a];
  BodyJacobian jacobian;
  relative_jacobian(tree, T_camera_body, static_cast<int>(a), static_cast<int>(b), jacobian);
  const auto numerical = numerical_jacobian(tree, configuration, [&](const auto& moved) {
    return log_se3(moved[b].inverse() * moved[a] * T_b_a.inverse());
  });
  EXPECT_LT((jacobian - numerical).cwiseAbs().maxCoeff(), 1e-8) << "bodies " << a << ", " << b;
}

/// Every chain of three out of the joint types, with a second branch, and mimics in both.
class ChainsOfThree : public testing::TestWithParam<int> {
 protected:
  KinematicTree tree() {
    constexpr std::array kTypes{JointType::revolute, JointType::continuous, JointType::prismatic};
    const auto type = [&](int digit) { return kTypes[static_cast<std::size_t>(digit % 3)]; };
    const int code = GetParam();
    KinematicTree tree;
    int body = 0;
    for (const int digit : {code, code / 3, code / 9}) {
      add_joint(tree, body++, type(digit), random_pose(generator_), random_vector(generator_));
    }
    add_joint(tree, 1, type(code), random_pose(generator_), random_vector(generator_));
    make_last_a_mimic(tree, 1, -0.7, 0.3);
    add_joint(tree, 4, type(code / 9), random_pose(generator_), random_vector(generator_));
    return tree;
  }

  std::mt19937 generator_{static_cast<unsigned>(GetParam())};
};

TEST_P(ChainsOfThree, BodyJacobiansAgreeWithNumericalDifferentiation) {
  const KinematicTree chain = tree();
  for (int i = 0; i < 5; ++i) {
    expect_exact_body_jacobians(chain, random_configuration(chain, generator_));
  }
}

TEST_P(ChainsOfThree, RelativeJacobiansAgreeWithNumericalDifferentiation) {
  const KinematicTree chain = tree();
  const Configuration configuration = random_configuration(chain, generator_);
  for (std::size_t a = 0; a < chain.bodies.size(); ++a) {
    for (std::size_t b = 0; b < chain.bodies.size(); ++b) {
      expect_exact_relative_jacobian(chain, configuration, a, b);
    }
  }
}

TEST_P(ChainsOfThree, WhatAVariableMovesIsWhereAllOfItWouldBe) {
  const KinematicTree chain = tree();
  Configuration configuration = random_configuration(chain, generator_);
  std::vector<Eigen::Isometry3d> T_camera_body = poses(chain, configuration);
  for (int variable = 0; variable < chain.variables(); ++variable) {
    configuration.q[variable] += random_vector(generator_).x();
    forward_kinematics_of(chain, configuration, moved_bodies(chain, variable), T_camera_body);
    const auto all = poses(chain, configuration);
    for (std::size_t b = 0; b < all.size(); ++b) {
      EXPECT_EQ(T_camera_body[b].matrix(), all[b].matrix()) << "variable " << variable;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(AllTypes, ChainsOfThree, testing::Range(0, 27));

TEST(RelativeJacobian, IsExactlyZeroForTheBaseAndForJointsThatCarryBoth) {
  std::mt19937 generator{1};
  KinematicTree tree;
  add_joint(tree, 0, JointType::revolute, random_pose(generator), random_vector(generator));
  add_joint(tree, 1, JointType::prismatic, random_pose(generator), random_vector(generator));
  add_joint(tree, 1, JointType::revolute, random_pose(generator), random_vector(generator));
  add_joint(tree, 0, JointType::revolute, random_pose(generator), random_vector(generator));
  const auto T_camera_body = poses(tree, random_configuration(tree, generator));
  BodyJacobian jacobian;
  relative_jacobian(tree, T_camera_body, 2, 3, jacobian);
  for (const int column : {0, 1, 2, 3, 4, 5, 6, 9}) {
    EXPECT_EQ(jacobian.col(column), Twist(Twist::Zero())) << "column " << column;
  }
  EXPECT_GT(jacobian.col(7).norm(), 0.1);
  EXPECT_GT(jacobian.col(8).norm(), 0.1);
}

TEST(ForwardKinematics, PlacesTheBodiesOfADoorWithASlidingBolt) {
  // The door turns about z at (1, 0, 0); on it, at (0, 2, 0), a bolt slides along the door's x.
  KinematicTree tree;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() = Eigen::Vector3d(1.0, 0.0, 0.0);
  add_joint(tree, 0, JointType::revolute, T, Eigen::Vector3d::UnitZ());
  T.translation() = Eigen::Vector3d(0.0, 2.0, 0.0);
  add_joint(tree, 1, JointType::prismatic, T, Eigen::Vector3d::UnitX());
  Configuration configuration = rest_configuration(tree);
  set_joint_position(tree, configuration, "joint0", kHalfPi);
  set_joint_position(tree, configuration, "joint1", 0.5);

  const auto T_camera_body = poses(tree, configuration);

  // Turned by 90 degrees the door's x is the base's y, and its y is the base's -x.
  EXPECT_TRUE(T_camera_body[2].translation().isApprox(Eigen::Vector3d(-1.0, 0.5, 0.0), 1e-14));
  EXPECT_TRUE(T_camera_body[2].linear().col(0).isApprox(Eigen::Vector3d::UnitY(), 1e-14));
}

TEST(ForwardKinematics, ReusesItsOutput) {
  std::mt19937 generator{2};
  KinematicTree tree;
  add_joint(tree, 0, JointType::revolute, random_pose(generator), random_vector(generator));
  const Configuration configuration = random_configuration(tree, generator);
  std::vector<Eigen::Isometry3d> T_camera_body;
  std::vector<BodyJacobian> jacobians;
  forward_kinematics(tree, configuration, T_camera_body);
  body_jacobians(tree, T_camera_body, jacobians);
  const auto* const pose_memory = T_camera_body.data();
  const double* const jacobian_memory = jacobians[1].data();
  forward_kinematics(tree, configuration, T_camera_body);
  body_jacobians(tree, T_camera_body, jacobians);
  EXPECT_EQ(T_camera_body.data(), pose_memory);
  EXPECT_EQ(jacobians[1].data(), jacobian_memory);
}

TEST(Configuration, RestsAtTheLimitNearestToZero) {
  KinematicTree tree;
  Joint& joint = add_joint(tree, 0, JointType::prismatic, Eigen::Isometry3d::Identity(),
                           Eigen::Vector3d::UnitX());
  joint.lower = 0.25;
  joint.upper = 0.5;
  EXPECT_EQ(rest_configuration(tree).q[0], 0.25);
}

TEST(Configuration, LimitsOfAVariableAreNotThoseOfItsMimics) {
  KinematicTree tree;
  add_joint(tree, 0, JointType::revolute, Eigen::Isometry3d::Identity(), Eigen::Vector3d::UnitX());
  add_joint(tree, 1, JointType::revolute, Eigen::Isometry3d::Identity(), Eigen::Vector3d::UnitX());
  make_last_a_mimic(tree, 0, -4.0, 1.0);
  const VariableLimits limits = variable_limits(tree, 0);
  EXPECT_DOUBLE_EQ(limits.lower, -2.0);
  EXPECT_DOUBLE_EQ(limits.upper, 2.0);
  Configuration configuration = rest_configuration(tree);
  set_joint_position(tree, configuration, "joint0", 0.5);
  EXPECT_DOUBLE_EQ(joint_position(tree, configuration, 1), -1.0);
}

TEST(Configuration, RangeOfAVariableReachesFromLimitToLimit) {
  KinematicTree tree;
  Joint& joint = add_joint(tree, 0, JointType::prismatic, Eigen::Isometry3d::Identity(),
                           Eigen::Vector3d::UnitX());
  joint.lower = 0.25;
  joint.upper = 0.5;
  const VariableRange range = variable_range(tree, 0, 7.0);
  EXPECT_FALSE(range.is_turn);
  EXPECT_EQ(positions_in(range, 2), (std::vector<double>{0.25, 0.375, 0.5}));
}

TEST(Configuration, RangeOfAVariableWithoutLimitsIsATurnThatCountsItsEndsOnce) {
  KinematicTree tree;
  add_joint(tree, 0, JointType::continuous, Eigen::Isometry3d::Identity(),
            Eigen::Vector3d::UnitX());
  const VariableRange range = variable_range(tree, 0, 1.0);
  EXPECT_TRUE(range.is_turn);
  EXPECT_DOUBLE_EQ(range.extent(), 2.0 * std::numbers::pi);
  const std::vector<double> positions = positions_in(range, 4);
  ASSERT_EQ(positions.size(), 4U);
  EXPECT_DOUBLE_EQ(positions.front(), 1.0 - std::numbers::pi);
  EXPECT_DOUBLE_EQ(positions[2], 1.0);
  EXPECT_DOUBLE_EQ(positions.back(), 1.0 + 0.5 * std::numbers::pi);
}

TEST(Configuration, StepsOverARangeAreBoundedHoweverLongItIs) {
  EXPECT_EQ(step_count(0.25, 0.1, 2, 63), 3);
  EXPECT_EQ(step_count(0.1, 0.5, 2, 63), 2);
  for (const double extent : {7.0, 1e9, 1e12, 1e308}) {
    EXPECT_EQ(step_count(extent, 0.1, 2, 63), 63) << extent;
  }
  EXPECT_EQ(step_count(1.0, 0.0, 2, 63), 63) << "infinitely many";
  EXPECT_EQ(step_count(0.0, 0.0, 2, 63), 63) << "not a number";
}

TEST(Configuration, RefusesUnknownAndMimicJointsByName) {
  KinematicTree tree;
  add_joint(tree, 0, JointType::revolute, Eigen::Isometry3d::Identity(), Eigen::Vector3d::UnitX());
  add_joint(tree, 1, JointType::revolute, Eigen::Isometry3d::Identity(), Eigen::Vector3d::UnitX());
  make_last_a_mimic(tree, 0, 2.0, 0.0);
  Configuration configuration = rest_configuration(tree);
  EXPECT_THROW(set_joint_position(tree, configuration, "dor", 0.0), InputError);
  EXPECT_THROW(set_joint_position(tree, configuration, "joint1", 0.0), InputError);
  try {
    joint_index(tree, "dor");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "joint 'dor': no such joint; there are joint0, joint1");
  }
}

}  // namespace
}  // namespace lockbox
