// SPDX-License-Identifier: BSD-3-Clause
// Random scenes of experiments that were once aligned wrongly.
#include <gtest/gtest.h>

#include <cmath>

#include "initialization/seen_model.hpp"
#include "lockbox/evaluation/accuracy_experiment.hpp"
#include "lockbox/evaluation/global_experiment.hpp"

namespace lockbox {
namespace {

/// The latch stands out by nine standard deviations at its handle, which the image takes for less.
TEST(HardFrames, LatchThatTheImageWouldTurn) {
  const ArticulatedModel& model = shipped("lockbox");
  const int joint = joint_index(model.tree, "latch");
  const int variable = model.tree.joints[static_cast<std::size_t>(joint)].variable;
  AccuracyExperiment experiment(model, {640, 480, 575.8, 575.8, 319.5, 239.5},
                                sensor_model("primesense"), 1, {}, Executor());
  const UnknownError latch =
      experiment.align_frame(83)[static_cast<std::size_t>(unknown_of(variable))];
  EXPECT_TRUE(latch.observable);
  EXPECT_LT(std::abs(latch.error), 4.0 * latch.sigma);
}

/// Of this cabinet on a table the best answer of the search is right, but for its hidden joints,
/// and goes 38 mm off when gates open. It was believed there for what the search had found.
TEST(HardFrames, AnswerThatDriftsOffIsNotBelievedWhereItComesToRest) {
  const ArticulatedModel& model = shipped("cabinet");
  GlobalExperiment experiment(model, {640, 480, 575.8, 575.8, 319.5, 239.5},
                              sensor_model("primesense"), 1, Executor());
  const GlobalResult found = experiment.search_scene(46);
  EXPECT_TRUE(found.within || found.status != TrackingStatus::tracking) << found.translation;
}

}  // namespace
}  // namespace lockbox
