// SPDX-License-Identifier: BSD-3-Clause
#include "box_turns.hpp"

#include <gtest/gtest.h>

namespace lockbox {
namespace {

const std::vector<Eigen::Isometry3d> kIdentityAlone{Eigen::Isometry3d::Identity()};

ModelExtent box(double x, double y, double z) {
  return {Eigen::Vector3d(0.3, -0.1, 0.2), Eigen::Vector3d(x, y, z), 0.5, {}};
}

TEST(BoxTurns, ABoxOfThreeSidesHasThree) {
  EXPECT_EQ(box_turns(box(0.9, 0.5, 0.2), kIdentityAlone).size(), 3U);
}

TEST(BoxTurns, ASquareBoardHasSeven) {
  EXPECT_EQ(box_turns(box(0.95, 0.95, 0.1), kIdentityAlone).size(), 7U);
}

TEST(BoxTurns, ACubeHasAllButOne) {
  EXPECT_EQ(box_turns(box(0.4, 0.4, 0.4), kIdentityAlone).size(), 23U);
}

TEST(BoxTurns, TheyTurnAboutTheMiddleOfTheBox) {
  const ModelExtent extent = box(0.4, 0.4, 0.4);
  for (const Eigen::Isometry3d& turn : box_turns(extent, kIdentityAlone)) {
    EXPECT_TRUE((turn * extent.centre).isApprox(extent.centre, 1e-12));
    EXPECT_NEAR(turn.linear().determinant(), 1.0, 1e-12);
  }
}

TEST(BoxTurns, WhatLooksTheSameIsNoOtherAnswer) {
  Eigen::Isometry3d half_turn = Eigen::Isometry3d::Identity();
  half_turn.linear() = Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitZ()).matrix();
  EXPECT_EQ(box_turns(box(0.9, 0.5, 0.2), std::vector{kIdentityAlone.front(), half_turn}).size(),
            2U);
}

/// Turns of a round foot that carries an arm, about an axis through the point.
std::vector<Eigen::Isometry3d> turns_about(const Eigen::Vector3d& point) {
  std::vector<Eigen::Isometry3d> turns;
  for (int step = 0; step < 8; ++step) {
    const Eigen::AngleAxisd turn(0.25 * M_PI * step, Eigen::Vector3d::UnitZ());
    turns.emplace_back(Eigen::Translation3d(point) * turn * Eigen::Translation3d(-point));
  }
  return turns;
}

TEST(BoxTurns, WhatMovesAsOneOfThemIsAddedOnce) {
  const ModelExtent extent = box(0.9, 0.5, 0.2);
  std::vector<Eigen::Isometry3d> turns = box_turns(extent, kIdentityAlone);
  add_turns_of_base(extent, turns_about(extent.centre), kIdentityAlone, turns);
  EXPECT_EQ(turns.size(), 3U + 6U);  // the half turn is one of the box, too
}

/// A jug whose plunger stands out: upside down it is where its body is, not its plunger.
TEST(BoxTurns, TheSameTurnAboutTheMiddleOfTheBaseIsAnother) {
  const ModelExtent extent = box(0.9, 0.5, 0.2);
  std::vector<Eigen::Isometry3d> turns = box_turns(extent, kIdentityAlone);
  const Eigen::Vector3d beside = extent.centre + Eigen::Vector3d(0.03, 0.0, 0.0);
  add_turns_of_base(extent, turns_about(beside), kIdentityAlone, turns);
  EXPECT_EQ(turns.size(), 3U + 7U);
}

}  // namespace
}  // namespace lockbox
