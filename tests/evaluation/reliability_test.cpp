// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/reliability.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lockbox {
namespace {

std::vector<StatedBelief> runs(std::size_t count, double belief, std::size_t right) {
  std::vector<StatedBelief> all(count, {belief, belief > 0.9, false});
  for (std::size_t i = 0; i < right; ++i) all[i].is_right = true;
  return all;
}

std::vector<StatedBelief> together(std::vector<StatedBelief> a,
                                   const std::vector<StatedBelief>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

TEST(WilsonInterval, IsThatOfTheTextbook) {
  // 8 of 10, by hand: (0.8 + 0.192) / 1.384 -+ 1.96 sqrt(0.016 + 0.0096) / 1.384.
  const Interval interval = wilson_interval(8, 10);
  EXPECT_NEAR(interval.lower, 0.4902, 1e-3);
  EXPECT_NEAR(interval.upper, 0.9433, 1e-3);
  EXPECT_EQ(wilson_interval(0, 0).upper, 1.0);
  EXPECT_EQ(wilson_interval(0, 50).lower, 0.0);
  EXPECT_GT(wilson_interval(50, 50).lower, 0.92);
}

TEST(ReliabilityBins, HoldEachRunOnceItsEdgesToo) {
  std::vector<StatedBelief> all;
  for (const double belief : {0.0, 0.0999, 0.1, 0.95, 0.99, 0.999, 1.0}) {
    all.push_back({belief, false, true});
  }
  const auto bins = reliability_bins(all);
  ASSERT_EQ(bins.size(), 12U);
  EXPECT_EQ(bins[0].runs, 2U);
  EXPECT_EQ(bins[1].runs, 1U);
  EXPECT_EQ(bins[9].runs, 1U);   // [.9, .99)
  EXPECT_EQ(bins[10].runs, 1U);  // [.99, .999)
  EXPECT_EQ(bins[11].runs, 2U);  // [.999, 1]
}

TEST(ReliabilityBins, HoldWhereTheStatedIsTheObserved) {
  EXPECT_TRUE(reliability_bins(runs(100, 0.75, 74))[7].holds());
  EXPECT_FALSE(reliability_bins(runs(100, 0.75, 95))[7].holds()) << "believed too little";
  EXPECT_FALSE(reliability_bins(runs(100, 0.95, 75))[9].holds()) << "believed too much";
  EXPECT_TRUE(reliability_bins(runs(29, 0.95, 0))[9].holds()) << "too few to tell";
}

TEST(Scores, AreThoseOfTheDefinition) {
  const Scores scores = scores_of_belief(runs(4, 0.9, 3));
  EXPECT_NEAR(scores.brier, (3 * 0.01 + 0.81) / 4, 1e-12);
  EXPECT_NEAR(scores.log_loss, -(3 * std::log(0.9) + std::log(0.1)) / 4, 1e-12);
  EXPECT_TRUE(std::isfinite(scores_of_belief(runs(1, 1.0, 0)).log_loss));
}

TEST(Scores, PreferBeliefsThatTellRightFromWrong) {
  const auto telling = together(runs(60, 0.98, 59), runs(40, 0.1, 3));
  const Scores constant = scores_of_constant(telling);
  EXPECT_NEAR(constant.brier, 0.62 * 0.38, 1e-12);
  EXPECT_LT(scores_of_belief(telling).brier, constant.brier);
  EXPECT_LT(scores_of_status(telling).brier, constant.brier);
  EXPECT_LT(scores_of_status(telling).log_loss, scores_of_belief(telling).log_loss)
      << "the status' shares are those that were observed";
}

}  // namespace
}  // namespace lockbox
