// SPDX-License-Identifier: BSD-3-Clause
#include "answer_comparison.hpp"

#include <gtest/gtest.h>

namespace lockbox {
namespace {

using Pixels = std::vector<std::uint8_t>;

const ModelLevers kLevers{Eigen::Vector3d(0.1, 0.0, 0.0), 0.1, {}};

Answer answer(double score, double total, const Pixels& explained, double turn,
              double aside = 0.0) {
  Answer result{{}, total, explained};
  result.candidate.score = score;
  Eigen::Isometry3d& pose = result.candidate.configuration.T_camera_base;
  pose = Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ());
  pose.pretranslate(Eigen::Vector3d(aside, 0.0, 1.0));
  return result;
}

/// A cube looks the same when it is turned; what hangs on it is elsewhere then. That part is not
/// quite as the model says, so the right answer has the lower score.
TEST(AnswerComparison, OfTurnsOfACubeTheOneThatExplainsItsNeighbourIsBest) {
  std::vector<Answer> answers{answer(27.0, 3560.0, {1, 1, 1, 0, 0, 0}, 3.1),
                              answer(26.0, 3530.0, {1, 1, 1, 0, 0, 0}, 1.6),
                              answer(20.0, 4730.0, {1, 1, 1, 1, 0, 0}, 0.0),
                              answer(16.0, 830.0, {0, 0, 0, 0, 0, 1}, 0.0, 0.5)};
  sort_best_first(answers, kLevers);
  EXPECT_EQ(answers[0].total, 4730.0);
  EXPECT_EQ(answers[0].candidate.score, 20.0);
  EXPECT_EQ(answers[1].total, 830.0);
  EXPECT_NEAR(answers[2].candidate.score, 20.0 * 3560.0 / 4730.0, 1e-12);
}

/// A near wall may be taken for a side of the object, behind which the object stands.
TEST(AnswerComparison, ElsewhereFewPixelsMayBeTheMoreConvincing) {
  std::vector<Answer> answers{answer(20.0, 4000.0, {1, 1, 1, 1, 1, 1}, 0.0, 0.5),
                              answer(30.0, 1000.0, {1, 1, 0, 0, 0, 0}, 0.0)};
  sort_best_first(answers, kLevers);
  EXPECT_EQ(answers[0].candidate.score, 30.0);
  EXPECT_EQ(answers[1].candidate.score, 20.0);
}

TEST(AnswerComparison, NearEachOtherTheOneThatExplainsMostIsBest) {
  std::vector<Answer> answers{answer(30.0, 900.0, {1, 1, 0, 0, 0, 0}, 0.0),
                              answer(20.0, 1000.0, {0, 0, 1, 1, 0, 0}, 0.1)};
  sort_best_first(answers, kLevers);
  EXPECT_EQ(answers[0].total, 1000.0);
}

/// A block upside down, of which another side lies where the right one is: a drawing in pixels
/// hardly tells them apart, but behind the wrong one points lie where its surface should be.
TEST(AnswerComparison, OfThoseThatExplainAboutTheSameTheMoreConvincingIsBest) {
  std::vector<Answer> answers{answer(15.5, 657.0, {1, 1, 1, 1, 0, 0}, 3.1),
                              answer(26.6, 655.0, {1, 1, 1, 0, 1, 0}, 0.0),
                              answer(8.0, 512.0, {1, 1, 1, 0, 0, 0}, 1.6)};
  sort_best_first(answers, kLevers);
  EXPECT_EQ(answers[0].total, 655.0);
  EXPECT_EQ(answers[0].candidate.score, 26.6);
  EXPECT_EQ(answers[1].candidate.score, 26.6 * 512.0 / 655.0);
  EXPECT_EQ(answers[2].candidate.score, 15.5);
}

TEST(AnswerComparison, FiftiethsOfTheEvidenceAreNoChance) {
  std::vector<Answer> answers{answer(26.3, 1989.0, {1, 1, 1, 1, 0, 0}, 3.1),
                              answer(41.4, 1947.0, {1, 1, 1, 0, 1, 0}, 0.0)};
  sort_best_first(answers, kLevers);
  EXPECT_EQ(answers[0].total, 1989.0);
  EXPECT_EQ(answers[0].candidate.score, 26.3);
}

TEST(AnswerComparison, ARivalIsNearlyAsConvincingAndDoesNotCompete) {
  const Answer best = answer(40.0, 4000.0, {1, 1, 1, 0, 0, 0}, 0.0);
  const Answer turned = answer(39.9, 3900.0, {1, 1, 1, 0, 0, 0}, 3.1);
  const Answer elsewhere = answer(39.5, 3000.0, {0, 0, 0, 1, 1, 1}, 0.0, 0.5);
  const Answer weak = answer(35.0, 3000.0, {0, 0, 0, 1, 1, 1}, 0.0, 0.5);
  EXPECT_EQ(rival_distance({best}, kLevers), 0.0);
  EXPECT_EQ(rival_distance({best, turned}, kLevers), 0.0);
  EXPECT_EQ(rival_distance({best, turned, weak}, kLevers), 0.0);
  EXPECT_NEAR(rival_distance({best, turned, elsewhere}, kLevers), 0.5, 1e-12);
}

}  // namespace
}  // namespace lockbox
