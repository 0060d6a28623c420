// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/tracking/repeated_image.hpp"

#include <gtest/gtest.h>

namespace lockbox {
namespace {

class RepeatedImageTest : public ::testing::Test {
 protected:
  /// How often the frame has to be shown until it tells nothing new; 0: more than ten times.
  int shown_until_rest(const DepthFrame& frame, bool is_found = true) {
    for (int times = 1; times <= 10; ++times) {
      if (image.shows_nothing_new(frame, is_found)) return times;
    }
    return 0;
  }

  static DepthFrame frame_of(std::uint16_t depth) {
    DepthFrame frame;
    frame.camera = {2, 1, 100.0, 100.0, 0.5, 0.0};
    frame.metres_per_unit = 0.001F;
    frame.depth = {depth, 800};
    return frame;
  }

  RepeatedImage image;
};

TEST_F(RepeatedImageTest, TellsNothingNewAfterFourRepeats) {
  EXPECT_EQ(shown_until_rest(frame_of(700)), 5);
  EXPECT_TRUE(image.shows_nothing_new(frame_of(700), true)) << "nor later";
}

TEST_F(RepeatedImageTest, TellsSomethingWhileTheObjectIsNotFoundInIt) {
  EXPECT_EQ(shown_until_rest(frame_of(700), false), 0);
  EXPECT_EQ(shown_until_rest(frame_of(700)), 4) << "of repeats since it was found";
}

TEST_F(RepeatedImageTest, IsAnotherOneIfAnythingDiffers) {
  DepthFrame moved = frame_of(700);
  moved.stamp = 3.0;
  shown_until_rest(frame_of(700));
  EXPECT_TRUE(image.shows_nothing_new(moved, true)) << "the time is not part of the image";
  EXPECT_FALSE(image.shows_nothing_new(frame_of(701), true)) << "a depth";
  shown_until_rest(frame_of(701));
  DepthFrame other_unit = frame_of(701);
  other_unit.metres_per_unit = 0.0001F;
  EXPECT_FALSE(image.shows_nothing_new(other_unit, true)) << "the unit";
  shown_until_rest(other_unit);
  DepthFrame other_camera = other_unit;
  other_camera.camera.fx = 101.0;
  EXPECT_FALSE(image.shows_nothing_new(other_camera, true)) << "the focal length";
}

}  // namespace
}  // namespace lockbox
