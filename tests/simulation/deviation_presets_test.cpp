// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/simulation/deviation_presets.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lockbox/core/error.hpp"
#include "lockbox/simulation/deviating_model.hpp"
#include "small_models.hpp"

namespace lockbox {
namespace {

TEST(DeviationPresets, EachKindDeviatesInItsOwnWayAndTheSeedDecides) {
  const KinematicTree tree = testing::board_with_three_joints();
  const std::string nothing = deviation_text(*preset_deviation("none", Severity::severe, 4, tree));
  for (const std::string& kind : deviation_kinds()) {
    if (kind == "none") continue;
    const auto deviation = preset_deviation(kind, Severity::severe, 4, tree);
    ASSERT_TRUE(deviation) << kind;
    const std::string text = deviation_text(*deviation);
    EXPECT_NE(text, nothing) << kind;
    EXPECT_EQ(deviation_text(*preset_deviation(kind, Severity::severe, 4, tree)), text);
    EXPECT_NO_THROW(deviating_model(tree, deviation->object, 4, Executor(1))) << kind;
  }
}

TEST(DeviationPresets, AmountsAreThoseOfTheSeverity) {
  const KinematicTree tree = testing::board_with_three_joints();
  const auto scale = [&](const std::string& kind, Severity severity) {
    return std::abs(preset_deviation(kind, severity, 1, tree)->object.scale - 1.0);
  };
  EXPECT_NEAR(scale("scale", Severity::moderate), 0.01, 1e-12);
  EXPECT_NEAR(scale("scale", Severity::severe), 0.02, 1e-12);
  EXPECT_NEAR(scale("all", Severity::moderate), 0.01 / 3.0, 1e-12);
  EXPECT_NEAR(scale("all", Severity::severe), 0.01 / 2.0, 1e-12);
  const auto centre = preset_deviation("centre", Severity::severe, 1, tree);
  EXPECT_NEAR(centre->sensor.camera.principal_point.norm(), 12.0, 1e-9);
}

TEST(DeviationPresets, BothSignsComeUp) {
  const KinematicTree tree = testing::board_with_three_joints();
  int larger = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    larger += preset_deviation("scale", Severity::moderate, seed, tree)->object.scale > 1.0 ? 1 : 0;
  }
  EXPECT_GT(larger, 3);
  EXPECT_LT(larger, 17);
}

TEST(DeviationPresets, WhatAModelDoesNotHaveCannotDeviate) {
  KinematicTree board = testing::board_with_three_joints();
  EXPECT_FALSE(preset_deviation("missing", Severity::moderate, 1, board));  // no handles
  EXPECT_TRUE(preset_deviation("missing", Severity::severe, 1, board));
  board.bodies.resize(1);
  board.joints.clear();
  board.variable_joint.clear();
  board.file_order.clear();
  EXPECT_FALSE(preset_deviation("missing", Severity::severe, 1, board));
  EXPECT_FALSE(preset_deviation("joints", Severity::severe, 1, board));
  EXPECT_THROW(preset_deviation("mood", Severity::severe, 1, board), InputError);
}

}  // namespace
}  // namespace lockbox
