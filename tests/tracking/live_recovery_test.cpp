// SPDX-License-Identifier: BSD-3-Clause
// A tracker whose frames do not wait for searches, on frames that come when their time has come.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <thread>

#include "lockbox/model/articulated_model.hpp"
#include "lockbox/tracking/tracker.hpp"
#include "mechanism.hpp"

namespace lockbox {
namespace {

constexpr double kPeriod = 1.0 / 30.0;
constexpr double kPatience = 120.0;  // seconds, of a search on a busy machine

class LiveRecovery : public ::testing::Test {
 protected:
  using Clock = std::chrono::steady_clock;
  using Motion = std::function<Configuration(double seconds)>;

  static TrackerOptions options() {
    TrackerOptions options;
    options.threads = 1;
    options.background_search = true;
    return options;
  }

  static double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
  }

  static bool is_tracking(const TrackingResult& result) {
    return result.status == TrackingStatus::tracking;
  }

  Configuration moved(double x, double turn) const {
    Configuration configuration = truth;
    configuration.T_camera_base.pretranslate(Eigen::Vector3d(x, 0.0, 0.1));
    configuration.T_camera_base.rotate(Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()));
    return configuration;
  }

  Configuration out_of_view() const { return moved(5.0, 0.0); }

  /// As seen at this moment.
  const TrackingResult& process(const Configuration& configuration) {
    std::this_thread::sleep_until(next_);
    next_ = std::max(Clock::now(), next_ + std::chrono::milliseconds(33));
    DepthFrame frame = measured(model, configuration, "primesense", ++frames_);
    frame.stamp = seconds_since(start_);
    return tracker.process(frame);
  }

  /// The number of frames until it is found in its motion, the last one included.
  int frames_until_found(const Motion& motion) {
    const auto start = Clock::now();
    int frames = 1;
    while (!is_tracking(process(motion(seconds_since(start)))) &&
           seconds_since(start) < kPatience) {
      ++frames;
    }
    return frames;
  }

  int frames_until_found(const Configuration& configuration) {
    return frames_until_found([&](double) { return configuration; });
  }

  void expect_near(const Configuration& expected) {
    const TrackingResult& result = process(expected);
    EXPECT_EQ(result.status, TrackingStatus::tracking);
    const Eigen::Isometry3d error =
        result.configuration.T_camera_base.inverse() * expected.T_camera_base;
    EXPECT_LT(error.translation().norm(), 5e-3);
    EXPECT_LT(Eigen::AngleAxisd(error.linear()).angle(), 0.02);
    EXPECT_NEAR(result.configuration.q[0], expected.q[0], 5e-3);
    EXPECT_NEAR(result.configuration.q[1], expected.q[1], 0.05);
  }

  const ArticulatedModel& model = mechanism();
  const Configuration truth = mechanism_start(model);
  Tracker tracker{model, options()};

 private:
  const Clock::time_point start_ = Clock::now();
  Clock::time_point next_ = start_;
  std::uint64_t frames_ = 0;
};

TEST_F(LiveRecovery, FramesGoOnUntilTheObjectIsFound) {
  const TrackingResult& first = process(truth);
  EXPECT_EQ(first.status, TrackingStatus::initializing);
  EXPECT_TRUE(std::isnan(first.configuration.q[0]));
  EXPECT_GT(frames_until_found(truth), 1);
  expect_near(truth);
  EXPECT_EQ(process(truth).searches, 1);
}

TEST_F(LiveRecovery, AGoodStartNeedsNoSearch) {
  tracker.start(truth);
  EXPECT_EQ(frames_until_found(truth), 1);
  expect_near(truth);
}

TEST_F(LiveRecovery, AStartThatIsSomewhatOffIsMended) {
  Configuration start = truth;
  start.T_camera_base.pretranslate(Eigen::Vector3d(0.04, 0.02, 0.03));
  tracker.start(start);
  frames_until_found(truth);
  expect_near(truth);
}

TEST_F(LiveRecovery, WhatMovesWhileItIsSoughtIsFoundWhereItIs) {
  const auto motion = [&](double seconds) { return moved(std::min(0.2, 0.05 * seconds), 0.0); };
  double shown = 0.0;
  frames_until_found([&](double seconds) {
    shown = seconds;
    return motion(seconds);
  });
  expect_near(motion(shown + kPeriod));
}

TEST_F(LiveRecovery, WhatIsElsewhereAllAtOnceIsFoundThere) {
  tracker.start(truth);
  ASSERT_EQ(frames_until_found(truth), 1);
  const Configuration elsewhere = moved(0.1, 1.0);
  EXPECT_GT(frames_until_found(elsewhere), 1);
  expect_near(elsewhere);
}

TEST_F(LiveRecovery, WhatComesBackWhereItWasNeedNotWaitForTheSearch) {
  tracker.start(truth);
  ASSERT_EQ(frames_until_found(truth), 1);
  for (int i = 0; i < 10; ++i) EXPECT_FALSE(is_tracking(process(out_of_view())));
  EXPECT_LE(frames_until_found(truth), 8);  // the longest pause between two looks
  expect_near(truth);
}

TEST_F(LiveRecovery, ANewStartOverridesTheSearch) {
  process(out_of_view());
  tracker.start(truth);
  EXPECT_EQ(frames_until_found(truth), 1);
}

}  // namespace
}  // namespace lockbox
