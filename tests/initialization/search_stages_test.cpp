// SPDX-License-Identifier: BSD-3-Clause
// The stages of the search one by one: the planes of a view, where templates fit on them, how well
// a drawing fits, the search along single unknowns, and what is kept of many guesses.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "coordinate_search.hpp"
#include "height_template.hpp"
#include "hypothesis.hpp"
#include "lockbox/core/lie.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/model/moved_bodies.hpp"
#include "model_extent.hpp"
#include "planar_regions.hpp"
#include "seen_model.hpp"
#include "template_matching.hpp"
#include "view_score.hpp"

namespace lockbox {
namespace {

constexpr int kColumns = 160;    // of the view that is searched first
constexpr double kNoise = 6e-4;  // 1/metre: of the median of 4 x 4 pixels of a PrimeSense

double angle_between(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return log_so3(a.linear().transpose() * b.linear()).norm();
}

/// Before a wall, as a PrimeSense-class sensor sees it.
class SearchStages : public ::testing::Test {
 protected:
  Configuration displaced(double metres) const {
    Configuration moved = truth_;
    moved.T_camera_base.pretranslate(Eigen::Vector3d(metres, 0.0, 0.0));
    return moved;
  }

  const ArticulatedModel& model_ = shipped("cabinet");
  const Configuration truth_ = *model_.parameters.initial_configuration;
  const Executor executor_{1};
  const CoarseView view_{seen(model_, truth_, wall_behind(0.6)), kColumns, executor_};
  const std::vector<std::uint8_t> all_ = std::vector<std::uint8_t>(model_.tree.bodies.size(), 1);
};

TEST_F(SearchStages, PlanesAreThoseOfTheWallAndOfTheSidesInSight) {
  const PlanarScene scene = find_planes(view_, kNoise);
  ASSERT_GE(scene.regions.size(), 3U);
  // The wall: square to the base, 0.6 m behind its origin.
  const Eigen::Vector3d normal = truth_.T_camera_base.linear().col(2);
  const Eigen::Vector3d on_wall = truth_.T_camera_base * Eigen::Vector3d(0.0, 0.0, -0.6);
  const PlanarRegion& largest = scene.regions.front();
  const Eigen::Vector3d m = largest.m.cast<double>();
  EXPECT_LT((hat(m.normalized()) * normal).norm(), 0.02);
  EXPECT_NEAR(m.dot(on_wall) / m.norm() - 1.0 / m.norm(), 0.0, 0.01);
  for (std::size_t i = 1; i < scene.regions.size(); ++i) {
    EXPECT_LE(scene.regions[i].samples.size(), scene.regions[i - 1].samples.size()) << i;
  }
  const Eigen::Isometry3d frame = region_frame(view_, largest);
  EXPECT_LT(frame.linear().col(2).dot(frame.translation()), 0.0) << "z towards the camera";
  EXPECT_NEAR(m.dot(frame.translation()), 1.0, 1e-3) << "in the plane";
}

TEST_F(SearchStages, ATemplateFitsWhereItsSideIsSeen) {
  const auto templates = make_height_templates(model_.tree, executor_, nullptr);
  ASSERT_FALSE(templates.empty());
  BodyPoses poses;
  forward_kinematics(model_.tree, truth_, poses);
  double nearest = 1.0;
  for (const PlanarRegion& region : find_planes(view_, kNoise).regions) {
    const HeightMap map = height_map(view_, region, kNoise, map_size(templates));
    for (const HeightTemplate& height_template : templates) {
      for (const TemplateMatch& match : match_template(map, height_template, 4, nullptr)) {
        const Eigen::Isometry3d& truth = poses[static_cast<std::size_t>(height_template.body)];
        if (angle_between(match.T_camera_body, truth) > 0.1) continue;
        nearest =
            std::min(nearest, (match.T_camera_body.translation() - truth.translation()).norm());
      }
    }
  }
  EXPECT_LT(nearest, 0.03);
}

TEST_F(SearchStages, MatchesOfOneTemplateAreRankedAndApart) {
  const auto templates = make_height_templates(model_.tree, executor_, nullptr);
  const PlanarRegion region = find_planes(view_, kNoise).regions.front();
  const HeightMap map = height_map(view_, region, kNoise, map_size(templates));
  const auto matches = match_template(map, templates.front(), 6, nullptr);
  ASSERT_GE(matches.size(), 2U);
  for (std::size_t i = 1; i < matches.size(); ++i) {
    EXPECT_LE(matches[i].score, matches[i - 1].score) << i;
    EXPECT_FALSE(matches[i].T_camera_body.isApprox(matches[0].T_camera_body, 1e-3)) << i;
  }
}

TEST_F(SearchStages, WhatIsThereScoresMoreThanWhatIsBesideIt) {
  ViewScore score(model_.tree, kNoise);
  score.set_view(view_);
  const ViewEvidence there = score.evidence(truth_, 0.003, all_);
  EXPECT_GT(there.explained, 0.8 * there.measured);
  EXPECT_LT(there.contradicted, 0.02 * there.measured);
  EXPECT_GT(there.in_view, 0.9);
  EXPECT_LT(there.continues, 0.3);
  for (const double metres : {-0.2, -0.05, 0.05, 0.2}) {
    EXPECT_LT(score.fit(displaced(metres), 0.003), score.fit(truth_, 0.003)) << metres;
    EXPECT_LT(score.evidence(displaced(metres), 0.003, all_).total(0.0), there.total(0.0))
        << metres;
  }
}

TEST_F(SearchStages, ADrawerIsWhereItsScoresAreHighest) {
  ViewScore score(model_.tree, kNoise);
  score.set_view(view_);
  const int drawer =
      model_.tree.joints[static_cast<std::size_t>(joint_index(model_.tree, "drawer"))].variable;
  std::vector<Configuration> trials;
  for (int i = 0; i <= 10; ++i) {
    trials.push_back(truth_);
    trials.back().q[drawer] = 0.02 * i;
  }
  const std::vector<std::uint8_t> none(all_.size(), 0);
  const auto scores = score.scan(trials, moved_bodies(model_.tree, drawer), none, 0.003);
  ASSERT_EQ(scores.size(), trials.size());
  const auto best = std::max_element(scores.begin(), scores.end()) - scores.begin();
  EXPECT_NEAR(0.02 * static_cast<double>(best), truth_.q[drawer], 0.021);
}

TEST_F(SearchStages, SearchAlongSingleUnknownsComesNearer) {
  std::vector<ViewScore> scores;
  scores.emplace_back(model_.tree, kNoise);
  scores.front().set_view(view_);
  Configuration found = displaced(0.03);
  coordinate_search(model_.tree, model_extent(model_.tree), {}, scores, executor_,
                    {{0.02, 0.01, 0.005}, 3, 0.003}, found);
  const Eigen::Vector3d off =
      found.T_camera_base.translation() - truth_.T_camera_base.translation();
  EXPECT_LT(off.norm(), 0.015);
  EXPECT_EQ(found.q, truth_.q) << "of joints none was named";
}

TEST_F(SearchStages, TheBestAreKeptAndNoPlaceCrowdsOutTheOthers) {
  const ModelExtent extent = model_extent(model_.tree);
  std::vector<Hypothesis> hypotheses;
  hypotheses.reserve(7);
  for (int i = 0; i < 5; ++i) {  // in one place, 5 cm from the next
    hypotheses.push_back({displaced(0.05 * i), all_, 100.0 - i});
  }
  hypotheses.push_back({displaced(6.0 * extent.radius), all_, 50.0});
  hypotheses.push_back({displaced(0.001), all_, 99.5});  // as good as the first
  hypotheses.push_back({displaced(-6.0 * extent.radius), all_, 5.0});
  const auto kept = best_apart(hypotheses, {0.2, 10, 2.0, 2, 2}, extent);
  ASSERT_EQ(kept.size(), 3U);
  EXPECT_EQ(kept[0].score, 100.0);
  EXPECT_EQ(kept[1].score, 99.0);
  EXPECT_EQ(kept[2].score, 50.0);
}

TEST_F(SearchStages, BasesAreApartOfASmallModelThatOfALargeOneAreNot) {
  const Hypothesis here{displaced(0.0), all_};
  const Hypothesis aside{displaced(0.02), all_};
  ModelExtent extent = model_extent(model_.tree);
  extent.radius = 0.05;  // a mug
  EXPECT_TRUE(are_apart(extent, here, aside));
  EXPECT_FALSE(has_base(extent, {here}, displaced(0.005).T_camera_base));
  extent.radius = 0.5;
  EXPECT_FALSE(are_apart(extent, here, aside));
  EXPECT_TRUE(has_base(extent, {here}, displaced(0.005).T_camera_base));
}

/// A square board looks much the same in four turns, and the wrong ones may look better.
TEST_F(SearchStages, NorDoesOneTurnCrowdOutTheOthersInItsPlace) {
  const ModelExtent extent = model_extent(model_.tree);
  std::vector<Hypothesis> hypotheses;
  for (int turn = 0; turn < 4; ++turn) {
    for (int i = 0; i < 4; ++i) {  // 5 cm from the next
      hypotheses.push_back({displaced(0.05 * i), all_, 100.0 - 10 * turn - i});
      hypotheses.back().configuration.T_camera_base.rotate(
          Eigen::AngleAxisd(turn * M_PI_2, Eigen::Vector3d::UnitZ()));
    }
  }
  std::vector<double> scores;
  for (const auto& kept : best_apart(hypotheses, {0.2, 40, 2.0, 8, 2}, extent)) {
    scores.push_back(kept.score);
  }
  EXPECT_EQ(scores, (std::vector{100.0, 99.0, 90.0, 89.0, 80.0, 79.0, 70.0, 69.0}));
}

}  // namespace
}  // namespace lockbox
