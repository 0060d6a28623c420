// SPDX-License-Identifier: BSD-3-Clause
// How probable what is reported is, and what may be right as well.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <numbers>

#include "../initialization/seen_model.hpp"
#include "../temporary_folder.hpp"
#include "lockbox/simulation/trajectory.hpp"
#include "lockbox/tracking/tracker.hpp"
#include "mechanism.hpp"

namespace lockbox {
namespace {

TrackerOptions on_one_thread() {
  TrackerOptions options;
  options.threads = 1;
  return options;
}

DepthFrame at_time(DepthFrame frame, int number) {
  frame.stamp = number / 30.0;
  return frame;
}

class BeliefTest : public ::testing::Test {
 protected:
  /// The mechanism on its wall, the n-th image of it.
  DepthFrame frame(const Configuration& configuration) {
    ++frames_;
    return at_time(
        measured(model, configuration, "primesense", static_cast<std::uint64_t>(frames_)), frames_);
  }

  const ArticulatedModel& model = mechanism();
  const Configuration truth = mechanism_start(model);
  Tracker tracker{model, on_one_thread()};

 private:
  int frames_ = 0;
};

TEST_F(BeliefTest, WhatIsInFullViewIsBelievedFromTheFirstFrameOn) {
  EXPECT_GT(tracker.process(frame(truth)).belief, 0.9999);
  const TrackingResult& followed = tracker.process(frame(truth));
  EXPECT_GT(followed.belief, 0.9999);
  EXPECT_TRUE(followed.alternatives.empty());
}

TEST_F(BeliefTest, AStartThatWasGivenIsAskedFor) {
  tracker.start(truth);
  EXPECT_GT(tracker.process(frame(truth)).belief, 0.9999);
}

TEST_F(BeliefTest, WhatIsNotFoundIsNotBelieved) {
  tracker.start(truth);
  tracker.process(frame(truth));
  DepthFrame dark = frame(truth);
  std::fill(dark.depth.begin(), dark.depth.end(), std::uint16_t{0});
  const TrackingResult& lost = tracker.process(dark);
  EXPECT_EQ(lost.status, TrackingStatus::lost);
  EXPECT_EQ(lost.belief, 0.0);
}

/// A box that a small part on its back tells from itself turned by half a turn.
constexpr auto kMarkedBox = R"(<robot name="marked_box"><link name="box">
  <visual><geometry><box size="0.3 0.2 0.1"/></geometry></visual>
  <visual><origin xyz="0.08 0.05 -0.06"/><geometry><box size="0.06 0.04 0.02"/></geometry></visual>
</link></robot>)";

class MarkedBox : public ::testing::Test {
 protected:
  MarkedBox() {
    std::ofstream(folder_.path() / "box.urdf") << kMarkedBox;
    model = load_model(folder_.path() / "box.urdf", with_cache());
  }

  /// Its back is hidden: it may as well be turned.
  Configuration ambiguous() const {
    Configuration configuration = rest_configuration(model.tree);
    configuration.T_camera_base = facing_pose(0.8) *
                                  Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitY()) *
                                  Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitX());
    return configuration;
  }

  /// Which does not turn with the box.
  static Scene wall() {
    Scene scene;
    scene.planes.push_back(
        {SceneFrame::world, {0.0, 0.0, 1.4}, -Eigen::Vector3d::UnitZ(), {8.0, 8.0}});
    return scene;
  }

  static TrackerOptions with_short_searches() {
    TrackerOptions options = on_one_thread();
    options.search_limit = 1.0;  // a round tells
    return options;
  }

  ArticulatedModel model;

 private:
  TemporaryFolder folder_;
};

TEST_F(MarkedBox, MayAsWellBeTurnedWhichIsSaid) {
  const Configuration truth = ambiguous();
  Configuration elsewhere = truth;  // too far, and turned too much, to be followed
  elsewhere.T_camera_base = Eigen::Translation3d(-0.35, 0.1, 0.2) * truth.T_camera_base *
                            Eigen::AngleAxisd(1.4, Eigen::Vector3d::UnitZ());
  Tracker tracker(model, with_short_searches());
  tracker.start(truth);
  ASSERT_EQ(tracker.process(at_time(seen_frame(model, truth, wall_behind(0.6)), 1)).status,
            TrackingStatus::tracking);
  TrackingResult found;
  for (int i = 2; i < 12 && found.alternatives.empty(); ++i) {
    found = tracker.process(
        at_time(seen_frame(model, elsewhere, wall_behind(0.6), static_cast<std::uint64_t>(i)), i));
  }
  EXPECT_EQ(found.status, TrackingStatus::uncertain);
  ASSERT_FALSE(found.alternatives.empty());
  const Alternative& other = found.alternatives.front();
  EXPECT_EQ(to_string(other.kind), "flip");
  EXPECT_GT(other.probability, 0.01);
  EXPECT_LE(other.probability + found.belief, 1.0);
  const Eigen::Isometry3d turn =
      found.configuration.T_camera_base.inverse() * other.configuration.T_camera_base;
  EXPECT_GT(Eigen::AngleAxisd(turn.linear()).angle(), 2.5);
}

TEST_F(MarkedBox, IsReportedBeforeItIsSureAndTrustedOnceTheViewTells) {
  const Configuration truth = ambiguous();
  Tracker tracker(model, with_short_searches());
  const TrackingResult first = tracker.process(at_time(seen_frame(model, truth, wall(), 1), 1));
  ASSERT_EQ(first.status, TrackingStatus::uncertain);
  EXPECT_LT(
      (first.configuration.T_camera_base.translation() - truth.T_camera_base.translation()).norm(),
      0.02);
  EXPECT_LT(first.belief, 0.9);
  EXPECT_FALSE(first.alternatives.empty());
  Configuration turned = truth;  // its back is seen now
  turned.T_camera_base =
      turned.T_camera_base * Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitY());
  TrackingResult found;
  for (int i = 2; i < 20 && found.status != TrackingStatus::tracking; ++i) {
    found = tracker.process(
        at_time(seen_frame(model, turned, wall(), static_cast<std::uint64_t>(i)), i));
  }
  EXPECT_EQ(found.status, TrackingStatus::tracking);
  EXPECT_TRUE(found.configuration.T_camera_base.isApprox(turned.T_camera_base, 0.02));
}

/// Something stands before its mark, and before where that may be as well. When it is gone, what
/// the search could not tell apart is compared: nothing is sought again.
TEST_F(MarkedBox, IsToldFromItsTurnedSelfWithoutAnotherSearch) {
  Configuration truth = ambiguous();
  truth.T_camera_base =
      truth.T_camera_base * Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitY());
  Scene covered = wall();
  for (const double side : {-1.0, 1.0}) {
    const Eigen::Vector3d mark =
        truth.T_camera_base * Eigen::Vector3d(side * 0.08, side * 0.05, -0.06);
    covered.planes.push_back(
        {SceneFrame::world, 0.8 * mark, -Eigen::Vector3d::UnitZ(), {0.07, 0.06}});
  }
  Tracker tracker(model, with_short_searches());
  TrackingResult found = tracker.process(at_time(seen_frame(model, truth, covered, 1), 1));
  ASSERT_EQ(found.status, TrackingStatus::uncertain);
  ASSERT_FALSE(found.alternatives.empty());
  for (int i = 2; i < 5; ++i) {
    found = tracker.process(
        at_time(seen_frame(model, truth, wall(), static_cast<std::uint64_t>(i)), i));
  }
  EXPECT_EQ(found.status, TrackingStatus::tracking);
  EXPECT_TRUE(found.alternatives.empty());
  EXPECT_EQ(found.searches, 1);
  EXPECT_TRUE(found.configuration.T_camera_base.isApprox(truth.T_camera_base, 0.02));
}

TEST_F(MarkedBox, IsForgottenNotLostWhereItWasNeverSure) {
  Tracker tracker(model, with_short_searches());
  DepthFrame frame = seen_frame(model, ambiguous(), wall(), 1);
  ASSERT_EQ(tracker.process(at_time(frame, 1)).status, TrackingStatus::uncertain);
  std::fill(frame.depth.begin(), frame.depth.end(), std::uint16_t{0});
  const TrackingResult& gone = tracker.process(at_time(frame, 2));
  EXPECT_EQ(gone.status, TrackingStatus::initializing);
  EXPECT_EQ(gone.belief, 0.0);
  EXPECT_FALSE(gone.configuration.T_camera_base.matrix().allFinite());
}

}  // namespace
}  // namespace lockbox
