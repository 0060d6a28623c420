// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/terms/collision_term.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "lockbox/core/error.hpp"
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
  EXPECT_EQ(off.evaluate(model, poses, nullptr), 0.0);
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
    const double expected = other.evaluate(model, poses, nullptr);
    EXPECT_EQ(used.evaluate(model, poses, nullptr), expected);
    NormalEquations asked_again;
    NormalEquations asked_first;
    for (NormalEquations* equations : {&asked_again, &asked_first}) {
      equations->set_zero(6 + model.tree.variables());
    }
    EXPECT_EQ(used.evaluate(model, poses, &asked_again), expected);
    CollisionTerm(fresh).evaluate(model, poses, &asked_first);
    EXPECT_EQ(asked_again.hessian, asked_first.hessian);
    EXPECT_EQ(asked_again.gradient, asked_first.gradient);
    penetrated += expected > 0.0 ? 1 : 0;
  }
  EXPECT_GT(penetrated, 5);
  EXPECT_LT(penetrated, 55);
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
