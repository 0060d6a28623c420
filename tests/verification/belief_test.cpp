// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/verification/belief.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace lockbox {
namespace {

TEST(Belief, WithTheLeastEvidenceItIsEven) {
  EXPECT_NEAR(belief(least_evidence(), {}), 0.5, 1e-12);
}

TEST(Belief, GrowsWithTheEvidence) {
  double before = 0.0;
  for (const double evidence : {-500.0, 0.0, 20.0, 40.0, 60.0}) {
    const double now = belief(evidence, {});
    EXPECT_GT(now, before) << evidence;
    before = now;
  }
}

/// One of the answers is right, or none is.
TEST(Belief, OfAllAnswersAndNoneAddsUpToOne) {
  const std::vector<double> all{45.0, 42.0, 33.0};
  double sum =
      std::exp(log_odds(least_evidence(), all[0])) * belief(all[0], std::vector{42.0, 33.0});
  sum += belief(all[0], std::vector{42.0, 33.0}) + belief(all[1], std::vector{45.0, 33.0}) +
         belief(all[2], std::vector{45.0, 42.0});
  EXPECT_NEAR(sum, 1.0, 1e-12);
}

TEST(Belief, MuchEvidenceDoesNotOverflow) {
  EXPECT_EQ(belief(1e6, std::vector{0.0}), 1.0);
  EXPECT_EQ(belief(-1e6, std::vector{0.0}), 0.0);
}

}  // namespace
}  // namespace lockbox
