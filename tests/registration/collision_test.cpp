// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <random>

#include "lockbox/core/error.hpp"
#include "lockbox/registration/collision_term.hpp"
#include "mechanism.hpp"

namespace lockbox {
namespace {

class CollisionTest : public ::testing::Test {
 protected:
  const ArticulatedModel& model = mechanism();

  double cost(CollisionTerm& term, const Configuration& configuration,
              NormalEquations* equations = nullptr) const {
    BodyPoses poses;
    forward_kinematics(model.tree, configuration, poses);
    if (equations != nullptr) {
      equations->set_zero(6 + model.tree.variables());
    }
    return term.evaluate(model, poses, equations);
  }
};

TEST_F(CollisionTest, FlushContactCostsNothingWhenEroded) {
  RegistrationOptions options;
  CollisionTerm eroded(model, options);
  std::mt19937 random(3);
  for (int trial = 0; trial < 30; ++trial) {
    Configuration at = mechanism_start(model);
    for (int v = 0; v < model.tree.variables(); ++v) {
      const VariableLimits limits = variable_limits(model.tree, v);
      const double lower = std::max(limits.lower, -1.0);
      const double upper = std::min(limits.upper, 1.0);
      at.q[v] = std::uniform_real_distribution<double>(lower, upper)(random);
    }
    EXPECT_EQ(cost(eroded, at), 0.0) << at.q.transpose();
  }
}

TEST_F(CollisionTest, OffCostsNothingAnywhere) {
  RegistrationOptions options;
  options.collision = CollisionMode::off;
  CollisionTerm off(model, options);
  EXPECT_TRUE(off.pairs().empty());
  EXPECT_EQ(cost(off, mechanism_start(model)), 0.0);
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
    CollisionTerm term(model, RegistrationOptions{});
    FAIL() << "accepted an erosion of half the plate";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("plate"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("10.0"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace lockbox
