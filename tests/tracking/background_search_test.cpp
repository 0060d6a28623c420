// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/tracking/background_search.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "lockbox/core/error.hpp"
#include "lockbox/tracking/acquisition.hpp"
#include "lockbox/tracking/classification.hpp"
#include "mechanism.hpp"

namespace lockbox {
namespace {

class BackgroundSearchTest : public ::testing::Test {
 protected:
  static TrackerOptions options() {
    TrackerOptions options;
    options.threads = 1;
    return options;
  }

  /// What the search says in the end.
  std::optional<Answer> wait() {
    std::optional<Answer> answer;
    while (search.is_busy()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      answer = search.take();
    }
    return answer;
  }

  static Configuration out_of_place(Configuration configuration) {
    configuration.T_camera_base.pretranslate(Eigen::Vector3d(5.0, 0.0, 0.0));
    return configuration;
  }

  const ArticulatedModel& model = mechanism();
  const Configuration truth = mechanism_start(model);
  const DepthFrame frame = measured(model, truth, "primesense");
  BackgroundSearch search{model, options()};
};

TEST_F(BackgroundSearchTest, FindsWhatASearchInTheForegroundFinds) {
  search.start(frame, std::nullopt, SearchScope::near_first);
  EXPECT_TRUE(search.is_busy());
  EXPECT_FALSE(search.take());
  const auto answer = wait();
  ASSERT_TRUE(answer);
  EXPECT_EQ(classify(*answer, options()), TrackingStatus::tracking);
  EXPECT_EQ(search.searches(), 1);

  const Executor executor(1);
  ArticulatedRegistration registration(model, options().registration, executor);
  TiledCloud cloud = cloud_of(frame);
  Acquisition acquisition(model, options(), executor, registration, cloud);
  const auto expected = acquisition.find(frame, std::nullopt, SearchScope::near_first);
  ASSERT_TRUE(expected);
  EXPECT_TRUE(
      answer->configuration.T_camera_base.isApprox(expected->configuration.T_camera_base, 0.0));
  EXPECT_EQ(answer->configuration.q, expected->configuration.q);
}

TEST_F(BackgroundSearchTest, LooksNearTheGuessFirst) {
  Configuration guess = truth;
  guess.T_camera_base.pretranslate(Eigen::Vector3d(0.03, 0.0, 0.02));
  search.start(frame, guess, SearchScope::near_first);
  const auto answer = wait();
  ASSERT_TRUE(answer);
  EXPECT_EQ(classify(*answer, options()), TrackingStatus::tracking);
  EXPECT_EQ(search.searches(), 0);
}

TEST_F(BackgroundSearchTest, FollowsWhatIsFoundIntoTheNewestFrame) {
  Configuration now = truth;
  now.T_camera_base.pretranslate(Eigen::Vector3d(0.03, 0.01, 0.02));
  set_joint_position(model.tree, now, "turn", -0.6);
  const DepthFrame after = measured(model, now, "primesense", 2);
  search.start(frame, truth, SearchScope::near_first);
  search.show(after);
  const auto answer = wait();
  ASSERT_TRUE(answer);
  EXPECT_EQ(classify(*answer, options()), TrackingStatus::tracking);
  const Eigen::Isometry3d error = answer->configuration.T_camera_base.inverse() * now.T_camera_base;
  EXPECT_LT(error.translation().norm(), 5e-3);
  EXPECT_LT((answer->configuration.q - now.q).norm(), 0.02);
}

TEST_F(BackgroundSearchTest, AnAnswerThatCannotBeFollowedIsThatOfItsOwnFrame) {
  const DepthFrame after = measured(model, out_of_place(truth), "primesense", 2);
  search.start(frame, truth, SearchScope::near_first);
  search.show(after);
  const auto answer = wait();
  ASSERT_TRUE(answer);
  EXPECT_EQ(classify(*answer, options()), TrackingStatus::tracking);
  const Eigen::Isometry3d error =
      answer->configuration.T_camera_base.inverse() * truth.T_camera_base;
  EXPECT_LT(error.translation().norm(), 5e-3);
}

TEST_F(BackgroundSearchTest, WhatWasCancelledGivesNoAnswerAndTheNextOneDoes) {
  search.start(frame, std::nullopt, SearchScope::near_first);
  search.cancel();
  EXPECT_FALSE(wait());
  search.start(frame, truth, SearchScope::near_first);
  EXPECT_TRUE(wait());
}

TEST_F(BackgroundSearchTest, AnErrorReachesTheCallerAndTheNextSearchWorks) {
  DepthFrame broken = frame;
  broken.depth.pop_back();
  search.start(broken, truth, SearchScope::near_first);
  EXPECT_THROW(wait(), InputError);
  EXPECT_FALSE(search.is_busy());
  search.start(frame, truth, SearchScope::near_first);
  EXPECT_TRUE(wait());
}

TEST_F(BackgroundSearchTest, EndsWhileItSearches) {
  for (const auto pause : {0, 20, 100}) {
    BackgroundSearch other(model, options());
    other.start(frame, std::nullopt, SearchScope::near_first);
    std::this_thread::sleep_for(std::chrono::milliseconds(pause));
    EXPECT_FALSE(other.take());
  }
}

}  // namespace
}  // namespace lockbox
