// SPDX-License-Identifier: BSD-3-Clause
#include "continued_frames.hpp"

#include <gtest/gtest.h>

namespace lockbox {
namespace {

class Frames : public testing::Test {
 protected:
  /// As they are handed on: seconds are those of arrival.
  DepthFrame add(int device_index, double stamp, double seconds) {
    DepthFrame frame;
    frame.stamp = stamp;
    const auto since_start = std::chrono::duration_cast<ContinuedFrames::Clock::duration>(
        std::chrono::duration<double>(seconds));
    frames_.add(device_index, ContinuedFrames::Clock::time_point() + since_start, frame);
    return frame;
  }

  ContinuedFrames frames_;
};

TEST_F(Frames, AreNumberedFromNoughtWithGapsWhereSomeWereMissed) {
  EXPECT_EQ(add(17, 5.0, 0.0).index, 0U);
  EXPECT_EQ(add(18, 5.1, 0.1).index, 1U);
  EXPECT_EQ(add(21, 5.4, 0.4).index, 4U);
  EXPECT_EQ(frames_.dropped(), 2U);
}

TEST_F(Frames, GoOnWhenTheDeviceCountsAnew) {
  add(17, 5.0, 0.0);
  add(18, 5.1, 0.1);
  frames_.reopen();
  const DepthFrame frame = add(1, 0.02, 3.1);
  EXPECT_EQ(frame.index, 2U);
  EXPECT_NEAR(frame.stamp, 8.1, 1e-9) << "by the three seconds that have passed";
  EXPECT_NEAR(add(2, 0.12, 3.9).stamp, 8.2, 1e-9) << "by the device's clock again";
  EXPECT_EQ(frames_.dropped(), 0U);
}

TEST_F(Frames, KeepTheStampsOfAClockThatWentOn) {
  add(17, 5.0, 0.0);
  frames_.reopen();
  EXPECT_EQ(add(1, 9.0, 3.0).stamp, 9.0);
  EXPECT_EQ(add(2, 9.1, 3.1).stamp, 9.1);
}

TEST_F(Frames, AreDatedAnewAfterEachAbsence) {
  add(1, 5.0, 0.0);
  frames_.reopen();
  EXPECT_NEAR(add(1, 0.0, 1.0).stamp, 6.0, 1e-9);
  frames_.reopen();
  EXPECT_NEAR(add(1, 0.0, 2.0).stamp, 7.0, 1e-9);
}

}  // namespace
}  // namespace lockbox
