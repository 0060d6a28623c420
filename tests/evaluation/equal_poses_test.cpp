// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/equal_poses.hpp"

#include <gmock/gmock.h>

#include "lockbox/core/lie.hpp"
#include "lockbox/core/units.hpp"
#include "lockbox/evaluation/metrics.hpp"
#include "lockbox/mesh/primitives.hpp"
#include "rigid_model.hpp"

namespace lockbox {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// Its middle is not where its frame is.
TriangleMesh aside(const TriangleMesh& mesh) {
  return transformed(mesh, Eigen::Isometry3d(Eigen::Translation3d(0.05, 0.1, 0.2)));
}

Eigen::Isometry3d somewhere() {
  return Eigen::Translation3d(0.1, -0.2, 1.2) *
         Eigen::AngleAxisd(0.7, Eigen::Vector3d(1.0, 2.0, 3.0).normalized());
}

Eigen::Isometry3d turned_about(const Eigen::Vector3d& axis, double degrees) {
  const Eigen::Translation3d middle(0.05, 0.1, 0.2);
  return somewhere() * middle * Eigen::AngleAxisd(kRadians * degrees, axis) * middle.inverse();
}

/// How far the two poses remain apart, in radians and metres together.
double apart(const EqualPoses& equal, const Eigen::Isometry3d& pose) {
  return log_se3(equal.nearest(somewhere(), pose).inverse() * pose).norm();
}

TEST(EqualPoses, AreNoneOfWhatLooksDifferentFromEverySide) {
  TriangleMesh mesh = make_box({0.3, 0.2, 0.1});
  append(mesh, transformed(make_box({0.04, 0.04, 0.04}),
                           Eigen::Isometry3d(Eigen::Translation3d(0.1, 0.05, 0.06))));
  const EqualPoses equal(rigid(mesh));
  EXPECT_FALSE(equal.any());
  EXPECT_THAT(equal.turns(), IsEmpty());
  EXPECT_GT(apart(equal, turned_about(Eigen::Vector3d::UnitZ(), 180.0)), 3.0);
}

TEST(EqualPoses, OfABoxAreHalfTurnsAndNothingBetween) {
  const EqualPoses equal(rigid(aside(make_box({0.3, 0.2, 0.1}))));
  EXPECT_THAT(equal.turns(),
              ElementsAre("180 degrees about x", "180 degrees about y", "180 degrees about z"));
  for (int axis = 0; axis < 3; ++axis) {
    const auto direction = Eigen::Vector3d::Unit(axis);
    EXPECT_LT(apart(equal, turned_about(direction, 180.0)), 1e-3);
    EXPECT_NEAR(apart(equal, turned_about(direction, 175.0)), 5.0 * kRadians, 0.03);
  }
}

TEST(EqualPoses, OfACubeAreAllItsTwentyFour) {
  const EqualPoses equal(rigid(aside(make_box({0.2, 0.2, 0.2}))));
  EXPECT_THAT(equal.turns(), testing::Contains("multiples of 90 degrees about x"));
  EXPECT_LT(apart(equal, turned_about(Eigen::Vector3d::Ones().normalized(), 120.0)), 1e-3);
  EXPECT_GT(apart(equal, turned_about(Eigen::Vector3d::UnitX(), 45.0)), 0.7);
}

/// Turns by 15 degrees pass, too, in a field of 2 mm. Whatever followed from them filled all turns.
TEST(EqualPoses, OfADieInACoarseFieldDoNotLeadOnAndOn) {
  const EqualPoses equal(rigid(aside(make_box({0.01, 0.01, 0.01}))));
  EXPECT_TRUE(equal.any());
  EXPECT_LT(apart(equal, turned_about(Eigen::Vector3d::UnitX(), 90.0)), 1e-3);
}

TEST(EqualPoses, AreNamedByAxesWithoutANegativeZero) {
  for (const Eigen::Vector3d& sizes :
       {Eigen::Vector3d(0.4, 0.04, 0.04), {0.04, 0.4, 0.04}, {0.04, 0.04, 0.4}}) {
    const EqualPoses equal(rigid(make_box(sizes)));
    for (const std::string& turn : equal.turns()) {
      EXPECT_THAT(
          turn, testing::Not(testing::AnyOf(testing::HasSubstr("-0,"), testing::HasSubstr("-0)"))));
    }
  }
}

TEST(EqualPoses, OfWhatIsRoundAreAllTurnsAboutItsAxisAndUpsideDown) {
  const EqualPoses equal(rigid(aside(make_cylinder(0.05, 0.12))));
  EXPECT_THAT(equal.turns(), testing::Contains("any angle about z"));
  EXPECT_LT(apart(equal, turned_about(Eigen::Vector3d::UnitZ(), 37.3)), 1e-3);
  EXPECT_LT(apart(equal, turned_about(Eigen::Vector3d(0.6, 0.8, 0.0), 180.0)), 1e-3);
  EXPECT_GT(apart(equal, turned_about(Eigen::Vector3d::UnitX(), 90.0)), 0.7);
}

TEST(EqualPoses, OfABallAreAllTurns) {
  const EqualPoses equal(rigid(aside(make_sphere(0.04))));
  EXPECT_THAT(equal.turns(), ElementsAre("any angle about any axis"));
  EXPECT_LT(apart(equal, turned_about(Eigen::Vector3d(0.0, 0.6, 0.8), 77.0)), 1e-3);
  EXPECT_GT(apart(equal, Eigen::Translation3d(0.02, 0.0, 0.0) * somewhere()), 0.01);
}

TEST(EqualPoses, CountAsTheTruthInAnEvaluation) {
  const ArticulatedModel model = rigid(aside(make_box({0.3, 0.2, 0.1})));
  const auto states = [](const Eigen::Isometry3d& pose) {
    return StatesFile{{}, {{0.0, {pose, Eigen::VectorXd()}, "tracking", true, {}}}};
  };
  const StatesFile estimate = states(turned_about(Eigen::Vector3d::UnitY(), 180.5));
  const StatesFile truth = states(somewhere());
  EXPECT_EQ(evaluate(model.tree, estimate, truth).statuses.tracking_but_wrong, 1U);
  const Evaluation modulo =
      evaluate(model.tree, estimate, truth, std::nullopt, {}, EqualPoses(model));
  EXPECT_EQ(modulo.statuses.tracking_but_wrong, 0U);
  EXPECT_NEAR(modulo.frames[0].rotation, 0.5 * kRadians, 1e-5);
}

}  // namespace
}  // namespace lockbox
