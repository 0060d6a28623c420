// SPDX-License-Identifier: BSD-3-Clause
// Property "exact derivatives": the gradient of the collision term against one-sided differences of
// its cost, for every joint type, in a chain of three, with a mimic joint.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "initialization/seen_model.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/terms/collision_term.hpp"
#include "overlaps.hpp"
#include "registration/mechanism.hpp"

namespace lockbox {
namespace {

/// A chain of three, each link beside a post of the base: a slide, a hinge on it, a wheel without
/// limits on the hinge; and a second slide that mimics the first one. All of them can run into
/// their posts, at an angle.
std::vector<std::string> colliding_elements() {
  const auto box = [](const std::string& at, const std::string& size) {
    return "<visual><origin " + at + "/><geometry><box size=\"" + size + "\"/></geometry></visual>";
  };
  return {"<link name=\"base\">" + box("xyz=\"0 0 0\"", "0.5 0.4 0.02") +
              box("xyz=\"0.06 0 0.04\" rpy=\"0 0 0.2\"", "0.02 0.06 0.06") +
              box("xyz=\"0.02 0.06 0.09\" rpy=\"0.1 0 0.3\"", "0.03 0.02 0.16") +
              box("xyz=\"0.05 -0.11 0.04\" rpy=\"0 0.1 -0.2\"", "0.02 0.06 0.06") + "</link>",
          "<link name=\"block\">" + box("xyz=\"0 0 0\"", "0.06 0.05 0.04") + "</link>",
          "<link name=\"arm\">" + box("xyz=\"0.05 0 0\"", "0.14 0.03 0.03") + "</link>",
          "<link name=\"wheel\">" + box("xyz=\"0 0 0\"", "0.12 0.02 0.02") + "</link>",
          "<link name=\"twin\">" + box("xyz=\"0 0 0\"", "0.06 0.05 0.04") + "</link>",
          R"(<joint name="slide" type="prismatic"><parent link="base"/><child link="block"/>
         <origin xyz="0 0 0.04"/><axis xyz="1 0 0"/>
         <limit lower="-0.1" upper="0.1" effort="1" velocity="1"/></joint>)",
          R"(<joint name="turn" type="revolute"><parent link="block"/><child link="arm"/>
         <origin xyz="0 0 0.05"/><axis xyz="0 0.1 1"/>
         <limit lower="-2" upper="2" effort="1" velocity="1"/></joint>)",
          R"(<joint name="spin" type="continuous"><parent link="arm"/><child link="wheel"/>
         <origin xyz="0.03 0 0.04"/><axis xyz="0.1 0 1"/></joint>)",
          R"(<joint name="follow" type="prismatic"><parent link="base"/><child link="twin"/>
         <origin xyz="-0.01 -0.11 0.04"/><axis xyz="1 0 0"/>
         <limit lower="-0.2" upper="0.2" effort="1" velocity="1"/>
         <mimic joint="slide" multiplier="0.9" offset="0.002"/></joint>)"};
}

TEST(ExactCollisionDerivatives, EveryKindOfJointAgreesWithNumericalDifferentiation) {
  const ArticulatedModel model = load_mechanism(colliding_elements(), with_cache());
  CollisionOptions options;
  options.collision = CollisionMode::literal;
  CollisionTerm term(model, options);
  Configuration at = rest_configuration(model.tree);
  const auto poses_at = [&](const Configuration& x) {
    BodyPoses poses;
    forward_kinematics(model.tree, x, poses);
    return poses;
  };
  const auto cost = [&](const Configuration& x, NormalEquations* equations) {
    return equations == nullptr ? term.cost(model, poses_at(x))
                                : term.linearize(model, poses_at(x), *equations);
  };
  const Eigen::Index unknowns = 6 + model.tree.variables();
  Eigen::VectorXi pushed = Eigen::VectorXi::Zero(unknowns);
  // Deeper than half a post another surface is the nearest one, which no derivative foresees.
  constexpr double kDeepest = 0.006;
  const Overlaps overlaps(model);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int trial = 0; trial < 40; ++trial) {
    do {
      at.q = Eigen::Vector3d(0.01 + 0.01 * uniform(random), 0.8 * uniform(random),
                             1.5 * uniform(random));
    } while (cost(at, nullptr) == 0.0 || overlaps.deepest(poses_at(at)) > kDeepest);
    NormalEquations equations;
    equations.set_zero(unknowns);
    const double here = cost(at, &equations);
    EXPECT_NEAR(cost(at, nullptr), here, 1e-12 * std::max(1.0, here));
    EXPECT_EQ(equations.gradient.head<6>(), Eigen::VectorXd::Zero(6))
        << "the base carries all bodies";
    for (Eigen::Index i = 6; i < unknowns; ++i) {
      constexpr double kStep = 2e-6;
      const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(unknowns, i);
      const double forward = (cost(stepped(at, step), nullptr) - here) / kStep;
      const double backward = (here - cost(stepped(at, -step), nullptr)) / kStep;
      // Where the selection changes on one side, the other one tells.
      const double off = std::min(std::abs(equations.gradient[i] - forward),
                                  std::abs(equations.gradient[i] - backward));
      EXPECT_LT(off, 0.03 * equations.gradient.tail(unknowns - 6).norm() + 1e-6)
          << "unknown " << i << " at " << at.q.transpose();
      pushed[i] += equations.gradient[i] != 0.0 ? 1 : 0;
    }
  }
  EXPECT_GE(pushed.tail(unknowns - 6).minCoeff(), 5) << "every joint met something";
}

}  // namespace
}  // namespace lockbox
