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

/// A round foot that carries an arm.
TEST(BoxTurns, WhatTurnsAsOneOfThemIsAddedOnce) {
  std::vector<Eigen::Isometry3d> of_base;
  for (int step = 0; step < 8; ++step) {
    of_base.emplace_back(Eigen::AngleAxisd(0.25 * M_PI * step, Eigen::Vector3d::UnitZ()));
  }
  std::vector<Eigen::Isometry3d> turns = box_turns(box(0.9, 0.5, 0.2), kIdentityAlone);
  add_turns_of_base(of_base, kIdentityAlone, turns);
  EXPECT_EQ(turns.size(), 3U + 6U);  // the half turn is one of the box, too
}

}  // namespace
}  // namespace lockbox
