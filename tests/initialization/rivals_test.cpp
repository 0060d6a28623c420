// SPDX-License-Identifier: BSD-3-Clause
#include "rivals.hpp"

#include <gtest/gtest.h>

#include "../evaluation/rigid_model.hpp"
#include "lockbox/mesh/primitives.hpp"
#include "lockbox/verification/belief.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

const Eigen::Vector3d kCentre(0.1, 0.0, 0.0);

TriangleMesh box(const Eigen::Vector3d& size, const Eigen::Vector3d& middle) {
  return transformed(make_box(size), Eigen::Isometry3d(Eigen::Translation3d(middle)));
}

/// 20 x 10 x 10 cm; looks the same in other poses.
const ArticulatedModel& brick() {
  static const ArticulatedModel model = rigid(box({0.2, 0.1, 0.1}, kCentre));
  return model;
}

/// As large, but with a chimney at one end.
const ArticulatedModel& house() {
  static const ArticulatedModel model = [] {
    TriangleMesh mesh = box({0.2, 0.1, 0.05}, {0.1, 0.0, -0.025});
    append(mesh, box({0.04, 0.03, 0.05}, {0.02, 0.02, 0.025}));
    return rigid(mesh);
  }();
  return model;
}

Candidate candidate(double evidence, double turn, double aside = 0.0) {
  Candidate result;
  result.evidence = evidence;
  Eigen::Isometry3d& pose = result.configuration.T_camera_base;
  pose = Eigen::Translation3d(aside, 0.0, 1.0) * Eigen::Translation3d(kCentre) *
         Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()) * Eigen::Translation3d(-kCentre);
  return result;
}

std::vector<Candidate> compared(std::vector<Candidate> candidates,
                                const ArticulatedModel& model = house()) {
  compare(SoughtModel(model, {}), candidates);
  return candidates;
}

TEST(Rivals, TheOneWithMostEvidenceIsFirst) {
  std::vector<Candidate> candidates{candidate(20.0, 3.1), candidate(96.0, 0.0),
                                    candidate(-40.0, 0.0, 0.5)};
  sort_best_first(candidates);
  EXPECT_EQ(candidates[0].evidence, 96.0);
  EXPECT_EQ(candidates[1].evidence, 20.0);
  EXPECT_EQ(candidates[2].evidence, -40.0);
}

/// So that what is found does not depend on how a sort breaks ties.
TEST(Rivals, EqualsKeepTheirOrder) {
  std::vector<Candidate> candidates{candidate(100.0, 0.0, 0.1), candidate(100.0, 0.0, 0.2)};
  sort_best_first(candidates);
  EXPECT_EQ(candidates[0].configuration.T_camera_base.translation().x(), 0.1);
}

TEST(Rivals, WithMuchEvidenceAndNoRivalAnAnswerIsSure) {
  const auto sure = compared({candidate(200.0, 0.0)});
  EXPECT_GT(sure[0].belief, 0.999999);
  EXPECT_LT(sure[0].rival_distance, 1e-6);
}

TEST(Rivals, WhatIsContradictedByAThirdIsNoMoreProbableThanNone) {
  Candidate answer = candidate(100.0, 0.0);
  answer.contradiction = 0.2;
  EXPECT_GT(compared({answer})[0].belief, 0.999999);
  answer.contradiction = 0.35;
  EXPECT_NEAR(compared({answer})[0].belief, 0.5, 1e-12);
  EXPECT_GT(compared({answer})[0].rival_distance, 0.5);
}

TEST(Rivals, WhatIsContradictedIsBelievedIfMoreIsLeftThanABoxShows) {
  Candidate answer = candidate(evidence_beyond_a_box(), 0.0);
  answer.contradiction = 0.35;
  EXPECT_GT(compared({answer})[0].belief, 0.999999);
}

TEST(Rivals, WithTheLeastEvidenceItIsAsProbableAsNot) {
  const auto even = compared({candidate(least_evidence(), 0.0)});
  EXPECT_NEAR(even[0].belief, 0.5, 1e-12);
  EXPECT_NEAR(even[0].rival_distance, std::sqrt(0.5), 0.01);  // a metre away, or not at all
}

TEST(Rivals, OfOnePlaceDoNotMakeThePlaceLessProbable) {
  const auto turned = compared({candidate(200.0, 0.0), candidate(200.0, M_PI)});
  EXPECT_GT(belief_in_place_of_first(SoughtModel(house(), {}), turned), 0.999999);
  const auto elsewhere = compared({candidate(200.0, 0.0), candidate(200.0, 0.0, 1.0)});
  EXPECT_NEAR(belief_in_place_of_first(SoughtModel(house(), {}), elsewhere), 0.5, 1e-9);
  EXPECT_EQ(belief_in_place_of_first(SoughtModel(house(), {}), {}), 0.0);
}

/// Turned about the middle, the base's origin moves by 0.2 m, the corners by their diagonal.
TEST(Rivals, ATurnedOneThatIsAsGoodIsAsProbable) {
  const auto even = compared({candidate(200.0, 0.0), candidate(200.0, M_PI)});
  EXPECT_NEAR(even[0].belief, 0.5, 1e-9);
  EXPECT_NEAR(even[0].rival_distance, std::sqrt(0.5) * std::hypot(0.2, 0.1), 1e-6);
}

TEST(Rivals, WhatIsHardlyApartIsTheSameAnswer) {
  EXPECT_GT(compared({candidate(200.0, 0.0), candidate(200.0, 0.05, 0.005)})[0].belief, 0.999999);
}

TEST(Rivals, WhatLooksTheSameIsTheSameAnswer) {
  const auto sure = compared({candidate(200.0, 0.0), candidate(200.0, M_PI)}, brick());
  EXPECT_GT(sure[0].belief, 0.999999);
  EXPECT_GT(sure[1].belief, 0.999999);
}

/// A round foot beside the base's origin, with a box that turns on it.
ArticulatedModel turntable() {
  const TemporaryFolder folder;
  return load_model(folder.write("turntable.urdf", R"(<robot name="turntable">
  <link name="foot"><visual><origin xyz="0.3 0 0"/><geometry>
    <cylinder radius="0.1" length="0.05"/></geometry></visual></link>
  <link name="top"><visual><origin xyz="0.05 0.02 0.06"/><geometry>
    <box size="0.2 0.08 0.06"/></geometry></visual></link>
  <joint name="turn" type="revolute"><parent link="foot"/><child link="top"/>
    <origin xyz="0.3 0 0"/><axis xyz="0 0 1"/>
    <limit lower="-2" upper="2" effort="1" velocity="1"/></joint></robot>)"),
                    {});
}

/// About the axis of the foot, and the top with it or not.
Candidate turned(double foot, double top) {
  Candidate result;
  result.evidence = 200.0;
  result.configuration.q = Eigen::VectorXd::Constant(1, top - foot);
  result.configuration.T_camera_base =
      Eigen::Translation3d(0.0, 0.0, 1.0) * Eigen::Translation3d(0.3, 0.0, 0.0) *
      Eigen::AngleAxisd(foot, Eigen::Vector3d::UnitZ()) * Eigen::Translation3d(-0.3, 0.0, 0.0);
  return result;
}

TEST(Rivals, ARoundFootTurnedBelowWhatItCarriesIsTheSameAnswer) {
  const ArticulatedModel model = turntable();
  ASSERT_EQ(model.round_axes.size(), 1U);
  EXPECT_GT(compared({turned(0.0, 0.4), turned(1.0, 0.4)}, model)[0].belief, 0.999999);
  EXPECT_NEAR(compared({turned(0.0, 0.4), turned(1.0, 1.4)}, model)[0].belief, 0.5, 1e-9);
}

TEST(Rivals, AWorseOneIsLessProbableTheMoreItLacks) {
  double before = 0.5;
  for (const double less : {1.0, 5.0, 20.0}) {
    const auto two = compared({candidate(200.0, 0.0), candidate(200.0 - less, 0.0, 0.5)});
    EXPECT_GT(two[0].belief, before);
    EXPECT_LT(two[1].belief, 0.5);
    before = two[0].belief;
  }
}

/// Found again from elsewhere, an answer is no second rival.
TEST(Rivals, ThatAreOneCountOnce) {
  const double once = compared({candidate(90.0, 0.0), candidate(80.0, 3.1)})[0].belief;
  const auto twice = compared({candidate(90.0, 0.0), candidate(80.0, 3.1), candidate(79.0, 3.11)});
  EXPECT_EQ(twice[0].belief, once);
}

TEST(Rivals, OfWhichAreManyDoNotCrowdOutTheOthers) {
  const SoughtModel sought(house(), {});
  std::vector<Candidate> candidates{candidate(90.0, 0.0), candidate(89.0, 0.01),
                                    candidate(88.0, 0.02), candidate(80.0, 3.1),
                                    candidate(79.0, 1.5)};
  keep_most_apart(sought, 2, candidates);
  ASSERT_EQ(candidates.size(), 3U);
  EXPECT_EQ(candidates[0].evidence, 90.0);
  EXPECT_EQ(candidates[1].evidence, 89.0) << "which may have other joints";
  EXPECT_EQ(candidates[2].evidence, 80.0);
}

}  // namespace
}  // namespace lockbox
