// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/simulation/deviating_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "lockbox/core/error.hpp"
#include "lockbox/core/lie.hpp"
#include "lockbox/mesh/mesh_audit.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/simulation/simulator.hpp"
#include "lockbox/simulation/trajectory.hpp"
#include "small_models.hpp"

namespace lockbox {
namespace {

const PinholeCamera kSmallCamera{320, 240, 287.9, 287.9, 159.5, 119.5};

KinematicTree built(const KinematicTree& tree, const ObjectDeviation& deviation,
                    std::uint64_t seed = 1) {
  return deviating_model(tree, deviation, seed, Executor(1));
}

/// Pixels in the middle row of the image that show something.
int shown_width(const KinematicTree& tree) {
  const State state = generate_trajectory(tree, {.frames = 1})[0];
  Simulator simulator(tree, kSmallCamera, PlacedScene(), sensor_model("ideal"), 1, Executor(1));
  DepthFrame frame;
  simulator.simulate(state, 0, frame);
  const auto row = frame.depth.begin() + 120 * 320;
  return static_cast<int>(320 - std::count(row, row + 320, 0));
}

TEST(DeviatingModel, WithoutDeviationsIsTheModel) {
  const KinematicTree tree = testing::board_with_three_joints();
  const KinematicTree same = built(tree, {});
  for (std::size_t b = 0; b < tree.bodies.size(); ++b) {
    EXPECT_EQ(same.bodies[b].mesh.vertices, tree.bodies[b].mesh.vertices);
  }
  for (std::size_t j = 0; j < tree.joints.size(); ++j) {
    EXPECT_TRUE(same.joints[j].T_parent_joint.isApprox(tree.joints[j].T_parent_joint, 1e-15));
  }
}

TEST(DeviatingModel, ScaleMakesWhatIsRenderedLarger) {
  const KinematicTree tree = testing::board_with_three_joints();
  const int nominal = shown_width(tree);
  EXPECT_NEAR(shown_width(built(tree, {.scale = 1.1})), 1.1 * nominal, 1.5);
  const KinematicTree larger = built(tree, {.scale = 1.01});
  EXPECT_NEAR(bounds(larger.bodies[0].mesh).sizes().x(), 0.606, 1e-12);
  EXPECT_NEAR(larger.joints[0].T_parent_joint.translation().x(), -0.1515, 1e-12);
}

TEST(DeviatingModel, SizesDifferByNoMoreThanTheAmountAndFromPartToPart) {
  const KinematicTree tree = testing::board_with_three_joints();
  const KinematicTree other = built(tree, {.sizes = 0.002});
  double most = 0.0;
  double least = 1.0;
  for (std::size_t b = 0; b < tree.bodies.size(); ++b) {
    const Eigen::Vector3d change =
        bounds(other.bodies[b].mesh).sizes() - bounds(tree.bodies[b].mesh).sizes();
    most = std::max(most, change.cwiseAbs().maxCoeff());
    least = std::min(least, change.cwiseAbs().minCoeff());
  }
  EXPECT_LE(most, 0.002 + 1e-12);
  EXPECT_GT(most, 0.001);
  EXPECT_LT(least, most);
}

// A base that is written from a corner grows away from it, and would not lie where it is seen.
TEST(DeviatingModel, TheBaseLiesWhereTheModelFitsIt) {
  KinematicTree tree = testing::board_with_three_joints();
  for (auto& vertex : tree.bodies[0].mesh.vertices) vertex += Eigen::Vector3d(1.0, 2.0, 0.0);
  const KinematicTree larger = built(tree, {.scale = 1.02});
  EXPECT_TRUE(
      bounds(larger.bodies[0].mesh).center().isApprox(bounds(tree.bodies[0].mesh).center(), 1e-9));
}

TEST(DeviatingModel, ABentBaseCarriesItsJointsAndStaysClosed) {
  const KinematicTree tree = testing::board_with_three_joints();
  const KinematicTree bent = built(tree, {.bend = 0.01});
  const TriangleMesh& mesh = bent.bodies[0].mesh;
  EXPECT_NEAR(bounds(mesh).sizes().z(), 0.02 + 0.01, 1e-4);
  EXPECT_TRUE(encloses_solid(mesh));
  // The fit lies between middle and ends, so that a joint moves by less than the bow, but moves.
  for (std::size_t j = 0; j < tree.joints.size(); ++j) {
    const double shift =
        (bent.joints[j].T_parent_joint.translation() - tree.joints[j].T_parent_joint.translation())
            .norm();
    EXPECT_GT(shift, 1e-4);
    EXPECT_LT(shift, 0.01);
  }
}

TEST(DeviatingModel, JointsAreOffByTheAmounts) {
  const KinematicTree tree = testing::board_with_three_joints();
  const KinematicTree other = built(tree, {.joint_origins = 0.003, .joint_axes = 0.01});
  for (std::size_t j = 0; j < tree.joints.size(); ++j) {
    const Joint& nominal = tree.joints[j];
    const Joint& joint = other.joints[j];
    const Eigen::Vector3d shift =
        joint.T_parent_joint.translation() - nominal.T_parent_joint.translation();
    EXPECT_NEAR(shift.norm(), 0.003, 1e-12);
    if (joint.type == JointType::prismatic) {  // along the axis it would be another zero
      EXPECT_NEAR(shift.dot(nominal.T_parent_joint.linear() * nominal.axis), 0.0, 1e-12);
    }
    const Eigen::Vector3d axis = joint.T_parent_joint.linear() * joint.axis;
    EXPECT_NEAR(std::acos(axis.dot(nominal.T_parent_joint.linear() * nominal.axis)), 0.01, 1e-6);
  }
}

TEST(DeviatingModel, AddedPartsCoverTheShareOfTheFrontThatIsAskedFor) {
  const KinematicTree tree = testing::board_with_three_joints();
  const auto area = [](const KinematicTree& of) {
    double sum = 0.0;
    for (const Body& body : of.bodies) sum += surface_area(body.mesh);
    return sum;
  };
  const KinematicTree few = built(tree, {.added_parts = 3});
  const KinematicTree many = built(tree, {.added_share = 0.15});
  EXPECT_GT(few.bodies[0].mesh.triangles.size(), tree.bodies[0].mesh.triangles.size());
  EXPECT_GT(area(few), area(tree));
  EXPECT_GT(area(many), area(few));
  EXPECT_GT(area(many) - area(tree), 0.15 * 0.6 * 0.6);
  EXPECT_THROW(built(tree, {.added_share = 0.99}), InputError);
}

TEST(DeviatingModel, TheSeedDecidesAll) {
  const KinematicTree tree = testing::board_with_three_joints();
  const ObjectDeviation deviation{
      .sizes = 0.002, .joint_origins = 0.003, .joint_axes = 0.01, .added_parts = 3};
  const KinematicTree first = built(tree, deviation, 5);
  const KinematicTree again = built(tree, deviation, 5);
  const KinematicTree other = built(tree, deviation, 6);
  for (std::size_t b = 0; b < tree.bodies.size(); ++b) {
    EXPECT_EQ(first.bodies[b].mesh.vertices, again.bodies[b].mesh.vertices);
  }
  EXPECT_NE(first.bodies[0].mesh.vertices, other.bodies[0].mesh.vertices);
  EXPECT_EQ(first.joints[0].T_parent_joint.matrix(), again.joints[0].T_parent_joint.matrix());
}

TEST(DeviatingModel, AMissingPartIsGoneWithWhatItCarries) {
  KinematicTree tree = testing::board_with_three_joints();
  tree.joints[1].parent_body = 1;  // the slider stands on the door
  const KinematicTree without = built(tree, {.missing_parts = {"door"}});
  EXPECT_TRUE(without.bodies[1].mesh.triangles.empty());
  EXPECT_TRUE(without.bodies[2].mesh.triangles.empty());
  EXPECT_FALSE(without.bodies[3].mesh.triangles.empty());
  EXPECT_EQ(without.joints.size(), tree.joints.size());
}

TEST(DeviatingModel, WhatTheModelDoesNotHaveCannotBeMissing) {
  const KinematicTree tree = testing::board_with_three_joints();
  EXPECT_THROW(built(tree, {.missing_parts = {"lid"}}), InputError);
  EXPECT_THROW(built(tree, {.missing_parts = {"board"}}), InputError);
  EXPECT_EQ(count_handles(tree), 0);
  EXPECT_THROW(built(tree, {.missing_handles = 1}), InputError);
}

TEST(DeviatingModel, AHandleOfTheShippedCabinetCanBeMissing) {
  const KinematicTree tree =
      load_kinematic_tree(LOCKBOX_SHARE_DIRECTORY "/models/cabinet/cabinet.urdf");
  ASSERT_GT(count_handles(tree), 0);
  const KinematicTree without = built(tree, {.missing_handles = 1});
  EXPECT_EQ(count_handles(without), count_handles(tree) - 1);
}

}  // namespace
}  // namespace lockbox
