// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/terms/collision_term.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "lockbox/core/error.hpp"
#include "lockbox/model/moved_bodies.hpp"
#include "registration/mechanism.hpp"

namespace lockbox {
namespace {

class CollisionTest : public ::testing::Test {
 protected:
  const ArticulatedModel& model = mechanism();
};

TEST_F(CollisionTest, OffCostsNothingAnywhere) {
  CollisionOptions options;
  options.collision = CollisionMode::off;
  CollisionTerm off(model, options);
  EXPECT_TRUE(off.pairs().empty());
  Configuration at = mechanism_start(model);
  at.q[0] = 0.13;  // beyond its limit the block reaches into the follower
  BodyPoses poses;
  forward_kinematics(model.tree, at, poses);
  EXPECT_EQ(off.cost(model, poses), 0.0);
}

/// What a term keeps of earlier calls spares it looking, and changes nothing.
TEST_F(CollisionTest, CostDoesNotDependOnWhatWasAskedBefore) {
  CollisionTerm used(model, CollisionOptions{});
  const CollisionTerm fresh(model, CollisionOptions{});
  std::mt19937 random(3);
  std::normal_distribution<double> step(0.0, 0.0015);
  Configuration at = mechanism_start(model);
  at.q[0] = 0.13;  // the block reaches into the follower
  BodyPoses poses;
  int penetrated = 0;
  for (int k = 0; k < 60; ++k) {
    for (double& q : at.q) {
      q += step(random);
    }
    at.q[0] = std::clamp(at.q[0], 0.11, 0.15);
    forward_kinematics(model.tree, at, poses);
    CollisionTerm other = fresh;
    const double expected = other.cost(model, poses);
    EXPECT_EQ(used.cost(model, poses), expected);
    NormalEquations asked_again;
    NormalEquations asked_first;
    for (NormalEquations* equations : {&asked_again, &asked_first}) {
      equations->set_zero(model.tree.unknowns());
    }
    EXPECT_EQ(used.linearize(model, poses, asked_again), expected);
    CollisionTerm(fresh).linearize(model, poses, asked_first);
    EXPECT_EQ(asked_again.hessian, asked_first.hessian);
    EXPECT_EQ(asked_again.gradient, asked_first.gradient);
    penetrated += expected > 0.0 ? 1 : 0;
  }
  EXPECT_GT(penetrated, 5);
  EXPECT_LT(penetrated, 55);
}

/// The rest of the cost does not change while nothing but that joint moves.
TEST_F(CollisionTest, CostBetweenIsWhatAJointCanChange) {
  CollisionTerm term(model, CollisionOptions{});
  Configuration at = mechanism_start(model);
  at.q[0] = 0.13;  // the block, on which the arm turns, reaches into the follower
  at.q[1] = 0.0;
  const auto costs = [&](int variable) {
    BodyPoses poses;
    forward_kinematics(model.tree, at, poses);
    const double all = term.cost(model, poses);
    return std::pair(all, term.cost_between(model, poses, moved_bodies(model.tree, variable)));
  };
  const auto [all, by_turn] = costs(1);
  const auto [all_again, by_slide] = costs(0);
  EXPECT_GT(all, 0.0);
  EXPECT_EQ(all_again, all) << "depends on what was asked before";
  EXPECT_NEAR(by_slide, 0.0, 1e-9 * all) << "the slide moves both";
  at.q[1] = 1.0;
  const auto [all_turned, by_turn_turned] = costs(1);
  EXPECT_NEAR(all_turned - all, by_turn_turned - by_turn, 1e-9 * all);
}

/// Links of a chain that bends reach into each other, as drawn, at nearly every angle: pushed
/// apart, the chain would be pulled straight. Links farther apart still may not meet.
TEST(CollisionPairTest, WhatAJointDrawsIntoEachOtherIsNoPair) {
  const auto link = [](const std::string& name) {
    return "<link name='" + name +
           "'><visual><origin xyz='0.05 0 0'/><geometry><box size='0.1 0.03 0.03'/></geometry>"
           "</visual></link>";
  };
  const auto joint = [](const std::string& parent, const std::string& child,
                        const std::string& limits) {
    return "<joint name='to_" + child + "' type='revolute'><parent link='" + parent +
           "'/><child link='" + child + "'/><origin xyz='0.1 0 0'/><axis xyz='0 0 1'/><limit " +
           limits + " effort='1' velocity='1'/></joint>";
  };
  for (const std::string bends :
       {"lower='-0.8' upper='0.8'", "lower='-0.4' upper='0.4'", "lower='0' upper='1.5'"}) {
    const ArticulatedModel chain = load_mechanism(
        {link("a"), link("b"), link("c"), joint("a", "b", bends), joint("b", "c", bends)}, {});
    std::vector<std::pair<int, int>> pairs;
    const CollisionTerm term(chain, CollisionOptions{});
    for (const CollisionPair& pair : term.pairs()) pairs.emplace_back(pair.a, pair.b);
    EXPECT_EQ(pairs, (std::vector<std::pair<int, int>>{{0, 2}})) << bends;
  }
}

/// No limits say where such a door may be, only its frame does.
TEST(CollisionPairTest, ADoorWithoutLimitsStaysOutOfItsFrame) {
  const ArticulatedModel door = load_mechanism(
      {"<link name='frame'><visual><geometry><box size='0.3 0.2 0.4'/></geometry></visual></link>",
       "<link name='leaf'><visual><origin xyz='-0.15 0.01 0'/><geometry><box size='0.3 0.02 0.4'/>"
       "</geometry></visual></link>",
       "<joint name='hinge' type='continuous'><parent link='frame'/><child link='leaf'/>"
       "<origin xyz='0.15 0.1 0'/><axis xyz='0 0 1'/></joint>"},
      {});
  EXPECT_EQ(CollisionTerm(door, CollisionOptions{}).pairs().size(), 1U);
}

TEST_F(CollisionTest, ErosionThatWouldMakeABodyVanishIsRefusedByName) {
  struct Restore {
    ArticulatedModel& model;
    ~Restore() { model.parameters.erosion.reset(); }
  };
  auto& changed = const_cast<ArticulatedModel&>(model);
  const Restore restore{changed};
  changed.parameters.erosion = 0.01;
  try {
    CollisionTerm term(model, CollisionOptions{});
    FAIL() << "accepted an erosion of half the plate";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("plate"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("10.0"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace lockbox
