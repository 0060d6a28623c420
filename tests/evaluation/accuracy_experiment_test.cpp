// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/accuracy_experiment.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "lockbox/evaluation/unknowns.hpp"
#include "slider_and_dial.hpp"

namespace lockbox {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

TEST(Unknowns, AreTheBasesTwistAndTheVariables) {
  const KinematicTree tree = slider_and_dial();
  EXPECT_EQ(unknown_names(tree),
            (std::vector<std::string>{"tx", "ty", "tz", "rx", "ry", "rz", "slider", "dial"}));
  std::vector<bool> lengths;
  lengths.reserve(8);
  for (int i = 0; i < 8; ++i) lengths.push_back(is_length(tree, i));
  EXPECT_EQ(lengths, (std::vector<bool>{true, true, true, false, false, false, true, false}));
}

TEST(AllowedError, IsTheFloorWhereTheBoundIsZero) {
  const KinematicTree tree = slider_and_dial();
  EXPECT_DOUBLE_EQ(allowed_error(tree, 0, 0.0), 0.05e-3);
  EXPECT_DOUBLE_EQ(allowed_error(tree, 3, 0.0), 0.005 * kDegree);
  EXPECT_DOUBLE_EQ(allowed_error(tree, 6, 0.0), 0.15e-3);
  EXPECT_DOUBLE_EQ(allowed_error(tree, 7, 0.0), 0.1 * kDegree);
}

TEST(AllowedError, GrowsWithTheBoundToHalfAsMuchAgain) {
  EXPECT_NEAR(allowed_error(slider_and_dial(), 0, 0.004), 0.006, 1e-6);
}

TEST(IsTold, EndsAtFiveMillimetresAndTwoDegrees) {
  const KinematicTree tree = slider_and_dial();
  EXPECT_TRUE(is_told(tree, 6, 0.0049));
  EXPECT_FALSE(is_told(tree, 6, 0.0051));
  EXPECT_TRUE(is_told(tree, 7, 1.9 * kDegree));
  EXPECT_FALSE(is_told(tree, 7, 2.1 * kDegree));
}

}  // namespace
}  // namespace lockbox
