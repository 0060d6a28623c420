// SPDX-License-Identifier: BSD-3-Clause
// Property "exact derivatives": the gradient of the collision term against two-sided differences of
// its cost, for every joint type, in a chain of three, with a mimic joint.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "initialization/seen_model.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/model/motion_scales.hpp"
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

/// What a part of a way changes the cost by at most, beside the mean of its parts.
constexpr double kJump = 4.0;

class ExactCollisionDerivatives : public ::testing::Test {
 protected:
  static CollisionOptions literal() {
    CollisionOptions options;
    options.collision = CollisionMode::literal;
    return options;
  }

  BodyPoses poses_at(const Configuration& x) const {
    BodyPoses poses;
    forward_kinematics(model.tree, x, poses);
    return poses;
  }

  double cost(const Configuration& x) { return term.cost(model, poses_at(x)); }

  /// Returns the cost.
  double linearize(const Configuration& x, NormalEquations& equations) {
    equations.set_zero(unknowns);
    return term.linearize(model, poses_at(x), equations);
  }

  /// Along the way of one unknown, surfaces moving by kHalfWay to both sides.
  struct Way {
    double change = 0.0;         ///< of the cost, by the unknown
    double mean_gradient = 0.0;  ///< of the unknown
    bool is_continuous = false;  ///< no sample passes from one surface to another
  };

  Way go(const Configuration& at, Eigen::Index unknown) {
    constexpr double kHalfWay = 5e-4;  // metres: the far side of thin bodies is found to 2e-6
    constexpr int kParts = 1000;
    const double half = kHalfWay / scales[unknown];
    const auto moved = [&](double share) {
      return stepped(at, share * half * Eigen::VectorXd::Unit(unknowns, unknown));
    };
    Way way;
    NormalEquations equations;
    double before = cost(moved(-1.0));
    way.change = -before;
    double largest = 0.0;
    for (int part = 0; part < kParts; ++part) {
      const double here = linearize(moved((2.0 * part + 1.0) / kParts - 1.0), equations);
      way.mean_gradient += equations.gradient[unknown] / kParts;
      largest = std::max(largest, std::abs(here - before));
      before = here;
    }
    const double after = cost(moved(1.0));
    way.change = (way.change + after) / (2.0 * half);
    way.is_continuous = largest < kJump / kParts * std::abs(way.change) * 2.0 * half;
    return way;
  }

  /// Bodies that reach into each other, but not deeper than half a post: from there another surface
  /// is the nearest one.
  Configuration penetrating() {
    constexpr double kDeepest = 0.006;
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    Configuration x = rest_configuration(model.tree);
    do {
      x.q = Eigen::Vector3d(0.01 + 0.01 * uniform(random), 0.8 * uniform(random),
                            1.5 * uniform(random));
    } while (cost(x) == 0.0 || overlaps.deepest(poses_at(x)) > kDeepest);
    return x;
  }

  const ArticulatedModel model = load_mechanism(colliding_elements(), with_cache());
  const Eigen::Index unknowns = model.tree.unknowns();
  const Eigen::VectorXd scales = motion_scales(model.tree);
  CollisionTerm term{model, literal()};
  const Overlaps overlaps{model};
  std::mt19937 random{4};
};

/// Where samples pass from cell to cell of a field the gradient jumps. So it is summed up over a
/// way: that is the difference of the costs at its ends, however many jumps it has. A sample that
/// passes to another surface makes the cost itself jump: such ways are rare, and left out.
TEST_F(ExactCollisionDerivatives, SumUpToDifferencesOfTheCost) {
  Eigen::VectorXi compared = Eigen::VectorXi::Zero(unknowns);
  NormalEquations here;
  for (int trial = 0; trial < 10; ++trial) {
    const Configuration at = penetrating();
    linearize(at, here);
    EXPECT_EQ(here.gradient.head<6>(), Eigen::VectorXd::Zero(6)) << "the base carries all bodies";
    for (Eigen::Index i = 6; i < unknowns; ++i) {
      if (here.gradient[i] == 0.0) continue;
      const Way way = go(at, i);
      if (!way.is_continuous) continue;
      EXPECT_NEAR(way.mean_gradient, way.change, 1e-4 * std::abs(way.change))
          << "unknown " << i << " at " << at.q.transpose();
      ++compared[i];
    }
  }
  EXPECT_GE(compared.tail(unknowns - 6).minCoeff(), 3);
}

}  // namespace
}  // namespace lockbox
