// SPDX-License-Identifier: BSD-3-Clause
// The parts of a search one by one: what proposes, what refines, and what is believed of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "../temporary_folder.hpp"
#include "assessment.hpp"
#include "exact_fit.hpp"
#include "lockbox/core/lie.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "proposer.hpp"
#include "refinement.hpp"
#include "search_image.hpp"
#include "seen_model.hpp"
#include "turned_answers.hpp"
#include "twin_bodies.hpp"

namespace lockbox {
namespace {

constexpr Selection kMany{0.05, 40, 0.5, 8, 8};
constexpr Breadth kBreadth{8, kMany, kMany, {0.15, 4, 0.5, 2, 2}, std::nullopt, 4, false, false};

/// A block before a wall.
class SearchParts : public ::testing::Test {
 protected:
  SearchParts() { image_.look_at(cloud_); }

  Hypothesis off_by(double metres, double radians) const {
    Hypothesis hypothesis{truth_, sought_.all_bodies};
    Eigen::Isometry3d& T_camera_base = hypothesis.configuration.T_camera_base;
    T_camera_base.pretranslate(Eigen::Vector3d(metres, 0.0, 0.0));
    T_camera_base.rotate(Eigen::AngleAxisd(radians, Eigen::Vector3d::UnitX()));
    return hypothesis;
  }
  double metres_off(const Configuration& found) const {
    return (found.T_camera_base.translation() - truth_.T_camera_base.translation()).norm();
  }
  double radians_off(const Configuration& found) const {
    return log_so3(found.T_camera_base.linear().transpose() * truth_.T_camera_base.linear()).norm();
  }

  const ArticulatedModel& model_ = shipped("rigid_block");
  const Configuration truth_ = facing(model_, 0.9, 0.5, 0.2);
  const TiledCloud cloud_ = seen(model_, truth_, wall_behind(0.5));
  const InitializerOptions options_;
  const Executor executor_{1};
  const SoughtModel sought_{model_, options_.registration};
  const ViewNoise noise_{options_.registration.noise.sigma_inverse_depth()};
  SearchImage image_{sought_, noise_, nullptr, executor_};
  ExactFit exact_{model_, options_, executor_};
  Refinement refinement_{sought_, options_, exact_, executor_};
};

TEST_F(SearchParts, TheFewerPixelsAViewHasTheLessNoiseIsLeft) {
  EXPECT_LT(noise_.coarse, noise_.fine);
  EXPECT_LT(noise_.fine, noise_.pixel);
}

TEST_F(SearchParts, AnExactSensorIsNoReasonToLookCloserThanObjectsAreLikeTheirModels) {
  const ViewNoise exact(1e-4);
  EXPECT_LT(exact.pixel, 0.1 * noise_.pixel);
  EXPECT_GT(exact.coarse, 0.9 * noise_.coarse);
  EXPECT_GT(exact.fine, 0.9 * noise_.fine);
}

TEST_F(SearchParts, TheWallIsLeftOutOfWhatMayBeTheObject) {
  const auto kept = [](const TiledCloud& cloud) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < cloud.depth().size(); ++i) {
      if (cloud.depth()[i] > 0.0F && cloud.keeps(i)) ++count;
    }
    return count;
  };
  EXPECT_LT(4 * kept(image_.object(truth_)), kept(cloud_));
  EXPECT_GT(kept(image_.object(truth_)), 1000U) << "the object itself";
}

TEST_F(SearchParts, SidesProposeAPlaceNearTheObject) {
  Proposer proposer(sought_, nullptr, executor_);
  const auto proposed = proposer.by_sides(image_, image_.scene(), truth_, kBreadth);
  ASSERT_FALSE(proposed.empty());
  EXPECT_TRUE(std::any_of(proposed.begin(), proposed.end(), [&](const Hypothesis& hypothesis) {
    return metres_off(hypothesis.configuration) < 0.04 &&
           radians_off(hypothesis.configuration) < 0.2;
  }));
}

TEST_F(SearchParts, EachStageComesNearer) {
  std::vector<Hypothesis> hypotheses{off_by(0.02, 0.1)};
  refinement_.place(image_, kBreadth, hypotheses);
  ASSERT_EQ(hypotheses.size(), 1U);
  EXPECT_LT(metres_off(hypotheses[0].configuration), 0.015);
  refinement_.pose(image_, kBreadth, hypotheses);
  refinement_.fit(image_, kBreadth, hypotheses);
  ASSERT_EQ(hypotheses.size(), 1U);
  EXPECT_LT(metres_off(hypotheses[0].configuration), 0.006);
  refinement_.fit_closely(image_, kBreadth, hypotheses);
  ASSERT_EQ(hypotheses.size(), 1U);
  EXPECT_LT(metres_off(hypotheses[0].configuration), 0.003);
  EXPECT_LT(radians_off(hypotheses[0].configuration), 0.02);
}

TEST_F(SearchParts, TwoThatComeToTheSamePlaceAreOne) {
  std::vector<Hypothesis> hypotheses{off_by(0.008, 0.03), off_by(-0.008, -0.03)};
  refinement_.fit_closely(image_, kBreadth, hypotheses);
  EXPECT_EQ(hypotheses.size(), 1U);
}

TEST_F(SearchParts, WhatIsFarBehindTheBestIsNotFollowed) {
  Assessment assessment(sought_, {}, exact_);
  assessment.look_at(image_, executor_);
  std::vector<Hypothesis> hypotheses{off_by(0.3, 0.0), off_by(0.0, 0.0)};
  assessment.leave_out_hopeless(0.0, 20.0, 4, hypotheses);
  ASSERT_EQ(hypotheses.size(), 1U);
  EXPECT_EQ(metres_off(hypotheses[0].configuration), 0.0);
  assessment.leave_out_hopeless(1e6, 20.0, 4, hypotheses);
  EXPECT_TRUE(hypotheses.empty()) << "an answer before is beyond reach";
}

TEST_F(SearchParts, AnswersAreExactAndTheMostConvincingComesFirst) {
  Assessment assessment(sought_, {}, exact_);
  assessment.look_at(image_, executor_);
  std::vector<Hypothesis> hypotheses{off_by(0.3, 0.0), off_by(0.004, 0.0)};
  for (Hypothesis& hypothesis : hypotheses) hypothesis.score = 1.0;
  std::vector<Candidate> answers;
  assessment.add_answers(image_, hypotheses, kMany, answers);
  ASSERT_EQ(answers.size(), 2U);
  EXPECT_LT(metres_off(answers[0].configuration), 0.002);
  EXPECT_GT(answers[0].evidence, answers[1].evidence);
  EXPECT_GT(answers[0].belief, answers[1].belief);
}

TEST_F(SearchParts, TurnsOfAnAnswerStayInItsPlace) {
  const auto turned = turned_answers(sought_, truth_, truth_);
  ASSERT_EQ(turned.size(), sought_.turns.size());
  for (const Hypothesis& hypothesis : turned) {
    EXPECT_LT(metres_off(hypothesis.configuration), 2.0 * sought_.extent.radius);
    EXPECT_GT(radians_off(hypothesis.configuration), 0.2);
  }
}

TEST_F(SearchParts, OfAnOpenDoorTheBaseMayStandAtAnyAngle) {
  const ArticulatedModel& cabinet = shipped("cabinet");
  const SoughtModel sought(cabinet, options_.registration);
  const Configuration held = rest_configuration(cabinet.tree);
  const auto hypotheses = with_body_at(sought, held, 1, Eigen::Isometry3d::Identity(), 4);
  ASSERT_EQ(hypotheses.size(), 5U);
  std::vector<Eigen::Isometry3d> poses;
  for (const Hypothesis& hypothesis : hypotheses) {
    forward_kinematics(cabinet.tree, hypothesis.configuration, poses);
    EXPECT_TRUE(poses[1].isApprox(Eigen::Isometry3d::Identity(), 1e-9));
    EXPECT_EQ(std::count(hypothesis.bodies.begin(), hypothesis.bodies.end(), 1), 2);
  }
}

/// Three drawers, of which the upper two are alike, as long as they are deep.
constexpr auto kChest = R"(<robot name="chest"><link name="carcass">
  <visual><origin xyz="0 0.25 0.3"/><geometry><box size="0.5 0.5 0.6"/></geometry></visual></link>
  <link name="low"><visual><origin xyz="0 0 0.08"/><geometry><box size="0.5 0.4 0.15"/></geometry></visual></link>
  <link name="middle"><visual><origin xyz="0 0 0.26"/><geometry><box size="0.5 0.4 0.2"/></geometry></visual></link>
  <link name="high"><visual><origin xyz="0 0 0.48"/><geometry><box size="0.5 0.4 0.2"/></geometry></visual></link>
  <joint name="a" type="prismatic"><parent link="carcass"/><child link="low"/><axis xyz="0 -1 0"/>
    <limit lower="0" upper="0.3" effort="1" velocity="1"/></joint>
  <joint name="b" type="prismatic"><parent link="carcass"/><child link="middle"/><axis xyz="0 -1 0"/>
    <limit lower="0" upper="0.3" effort="1" velocity="1"/></joint>
  <joint name="c" type="prismatic"><parent link="carcass"/><child link="high"/><axis xyz="0 -1 0"/>
    <limit lower="0" upper="0.3" effort="1" velocity="1"/></joint>
</robot>)";

TEST(TwinBodies, ADrawerPassesForTheNextOneOfItsSizeWhereverItStands) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "chest.urdf") << kChest;
  const ArticulatedModel model = load_model(folder.path() / "chest.urdf", with_cache());
  const SoughtModel sought(model, RegistrationOptions{});
  Configuration answer = facing(model, 1.5, 0.3, 0.1);
  answer.q << 0.0, 0.1, 0.25;
  const Configuration held = rest_configuration(model.tree);
  const auto moved = moved_along_twins(sought, held, answer);
  // The upper two stand for each other, open as far: the base goes up or down by a drawer.
  std::vector<double> heights;
  for (const Hypothesis& hypothesis : moved) {
    const Eigen::Vector3d way =
        answer.T_camera_base.inverse() * hypothesis.configuration.T_camera_base.translation();
    EXPECT_LT(way.head<2>().norm(), 1e-9);
    heights.push_back(way.z());
    EXPECT_EQ(std::count(hypothesis.bodies.begin(), hypothesis.bodies.end(), 1), 2);
  }
  EXPECT_THAT(heights, testing::UnorderedElementsAre(testing::DoubleNear(0.22, 1e-9),
                                                     testing::DoubleNear(-0.22, 1e-9)));
}

}  // namespace
}  // namespace lockbox
