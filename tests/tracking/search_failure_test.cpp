// SPDX-License-Identifier: BSD-3-Clause
// What is said where the object is not found: each reason on a simulated frame that has it.
#include "lockbox/tracking/search_failure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "lockbox/core/parallel.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/registration/articulated_registration.hpp"
#include "lockbox/tracking/tracker.hpp"
#include "lockbox/verification/agreement.hpp"
#include "search_failure_fixture.hpp"

namespace lockbox {
namespace {

using ::testing::HasSubstr;

TEST_F(SearchFailureTest, AFrameThatIsSoundExplainsNothing) {
  EXPECT_FALSE(is_explained(failure()));
  EXPECT_THAT(said(failure()), HasSubstr("Nothing in view resembles the model"));
  EXPECT_GT(failure().measured, 0.8);
  EXPECT_EQ(failure().too_far, 0.0);
  EXPECT_NEAR(failure().field_of_view, 58.1, 0.1);
  EXPECT_THAT(said(failure()), HasSubstr("it sees 58 degrees"));
  EXPECT_THAT(said(failure()), HasSubstr("it is 0.32 m across"));
}

TEST_F(SearchFailureTest, TheModelLooksTheSameInOtherConfigurations) {
  SearchFailure same = failure();
  same.look_alikes = 3;
  EXPECT_THAT(said(same), HasSubstr("in at least 3 other ways"));
  EXPECT_THAT(said(same), HasSubstr("--initial-state"));
}

TEST_F(SearchFailureTest, NoPixelHasADepth) {
  look_at_wall(0);
  EXPECT_TRUE(is_explained(failure()));
  EXPECT_THAT(said(failure()), HasSubstr("No pixel has a depth"));
}

TEST_F(SearchFailureTest, FewPixelsHaveADepth) {
  for (std::size_t i = 0; i < frame.depth.size(); ++i) {
    if (i % 20 != 0) frame.depth[i] = 0;
  }
  EXPECT_FALSE(is_explained(failure())) << "it may be enough";
  EXPECT_THAT(said(failure()), HasSubstr("Only"));
  EXPECT_THAT(said(failure()), HasSubstr("of the pixels have a depth"));
}

TEST_F(SearchFailureTest, EverythingIsBeyondTheRange) {
  frame.metres_per_unit = 0.01F;
  EXPECT_GT(failure().too_far, 0.9);
  EXPECT_THAT(said(failure()), HasSubstr("farther than 5 m"));
  EXPECT_THAT(said(failure()), HasSubstr("--depth-scale 1000."));
  frame.metres_per_unit = 1.0F;
  EXPECT_THAT(said(failure()), HasSubstr("--depth-scale 1000."));
}

TEST_F(SearchFailureTest, EverythingIsNearerThanTheRange) {
  frame.metres_per_unit = 1e-4F;
  EXPECT_GT(failure().too_near, 0.9);
  EXPECT_THAT(said(failure()), HasSubstr("nearer than 0.2 m"));
  EXPECT_THAT(said(failure()), HasSubstr("--depth-scale 1000."));
}

TEST_F(SearchFailureTest, AFarSceneMayBeOne) {
  look_at_wall(30000);
  EXPECT_THAT(said(failure()), HasSubstr("if that is wrong, try --depth-scale 10000."));
}

TEST_F(SearchFailureTest, NoCameraHasSuchAFocalLength) {
  frame.camera.fx *= 10.0;
  EXPECT_THAT(said(failure()), HasSubstr("--camera-info"));
  frame.camera.fx /= 200.0;
  EXPECT_THAT(said(failure()), HasSubstr("--camera-info"));
}

TEST_F(SearchFailureTest, TheModelIsLargerThanTheView) {
  look_at_wall(220);
  const SearchFailure found = search_failure(frame, mechanism().tree, options(), nullptr);
  EXPECT_THAT(said(found), HasSubstr("m across, but the view no more than 0.24 m"));
  EXPECT_THAT(said(found), HasSubstr("--mesh-scale"));
}

TEST_F(SearchFailureTest, TheModelIsTooSmallToBeSeen) {
  look_at_wall(4900);
  frame.camera = {40, 30, 36.0, 36.0, 19.5, 14.5};
  frame.depth.resize(40 * 30);
  EXPECT_THAT(said(failure()), HasSubstr("pixels even where the view is nearest"));
}

TEST_F(SearchFailureTest, ThePrincipalPointIsToBeChecked) {
  frame.camera.cx = 99.5;
  EXPECT_THAT(said(failure()), HasSubstr("cx 99.5, cy 119.5 (--camera-info), where the image's "
                                         "middle is 159.5, 119.5"));
}

TEST_F(SearchFailureTest, TheLikeliestPlaceIsSaid) {
  RegistrationResult best;
  best.configuration = truth;
  best.agreement.explained = 0.34;
  best.agreement.contradicted = 0.22;
  best.agreement.occluded = 0.1;
  best.body_agreement.resize(model.tree.bodies.size());
  Agreement& body = best.body_agreement.front();
  body.contradicted = 0.9;
  body.pixels = 1000.0;
  const std::string text = said(failure(&best));
  EXPECT_THAT(text, HasSubstr("0.7 m away"));
  EXPECT_THAT(text, HasSubstr("34 % of the model's visible surface"));
  EXPECT_THAT(text, HasSubstr("22 % are seen through"));
  EXPECT_THAT(text, HasSubstr("'" + model.tree.bodies.front().name + "'"));
}

TEST_F(SearchFailureTest, TheTrackerTellsUntilItHasFoundTheObject) {
  Tracker tracker(model, options());
  EXPECT_FALSE(tracker.search_failure());
  DepthFrame dark = frame;
  std::fill(dark.depth.begin(), dark.depth.end(), std::uint16_t{0});
  tracker.process(dark);
  ASSERT_TRUE(tracker.search_failure());
  EXPECT_EQ(tracker.search_failure()->measured, 0.0);
  EXPECT_EQ(tracker.process(frame).status, TrackingStatus::tracking);
  EXPECT_FALSE(tracker.search_failure());
}

/// Not in the first search: a camera may not be aimed yet.
TEST_F(SearchFailureTest, ATrackerOfLiveFramesTellsThatTheyAreMirroredLater) {
  const ArticulatedModel corner = box_with(R"(
    <visual><origin xyz="-0.105 0.02 0.11"/><geometry><box size="0.03 0.12 0.14"/></geometry></visual>
    <visual><origin xyz="0.04 0.065 0.08"/><geometry><box size="0.12 0.03 0.08"/></geometry></visual>)");
  std::vector<DepthFrame> frames;  // an image that is shown again is not searched again
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    frame = every_second_pixel(measured(corner, mechanism_start(corner), "primesense", seed));
    mirror();
    frames.push_back(frame);
  }
  TrackerOptions live = options();
  live.try_other_readings = true;
  live.background_search = true;
  Tracker tracker(corner, live);
  const auto is_told = [&] {
    return tracker.search_failure() && tracker.search_failure()->is_mirrored;
  };
  int searches = 0;
  const auto give_up =
      std::chrono::steady_clock::now() + LOCKBOX_SLOWDOWN * std::chrono::minutes(2);
  while (!is_told() && std::chrono::steady_clock::now() < give_up) {
    std::this_thread::sleep_for(std::chrono::milliseconds(33));
    const double stamp = frame.stamp + 1.0 / 30.0;
    frame = frames[static_cast<std::size_t>(30.0 * stamp) % frames.size()];
    frame.stamp = stamp;
    searches = tracker.process(frame).searches;
  }
  EXPECT_TRUE(is_told());
  EXPECT_GE(searches, 2);
}

/// A round a frame: what is not found in the first one may be in the next.
TEST_F(SearchFailureTest, ASearchThatGoesOnHasNotFailedYet) {
  TrackerOptions in_rounds = options();
  in_rounds.search_limit = 1.5;
  Tracker tracker(model, in_rounds);
  DepthFrame dark = frame;
  std::vector<int> failed;
  for (int i = 0; i < 10; ++i) {
    std::fill(dark.depth.begin(), dark.depth.end(), std::uint16_t{0});
    dark.depth.front() = static_cast<std::uint16_t>(500 + i);  // another image each time
    tracker.process(dark);
    if (tracker.search_failure()) failed.push_back(i);
  }
  EXPECT_EQ(failed, (std::vector{4, 5, 6, 7, 8, 9})) << "searched in frames 0, 1, 2, and 4";
  EXPECT_EQ(tracker.process(frame).status, TrackingStatus::tracking);
}

TEST_F(SearchFailureTest, ATrackerWhoseSearchIsStoppedGoesOnAsIfTheFrameHadNotCome) {
  bool is_stopped = true;
  TrackerOptions stoppable = options();
  stoppable.stop_request = [&is_stopped] { return is_stopped; };
  Tracker tracker(model, stoppable);
  EXPECT_THROW(tracker.process(frame), Stopped);
  is_stopped = false;
  const TrackingResult& found = tracker.process(frame);
  EXPECT_EQ(found.status, TrackingStatus::tracking);
  EXPECT_LT(
      (found.configuration.T_camera_base.translation() - truth.T_camera_base.translation()).norm(),
      0.005);
}

}  // namespace
}  // namespace lockbox
