// SPDX-License-Identifier: BSD-3-Clause
// The view beside a loop over frames, on a real (virtual) X display.
#include "lockbox/visualization/live_view.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "block_model.hpp"
#include "x_user.hpp"

namespace lockbox {
namespace {

class LiveViewTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!user_.is_connected()) GTEST_SKIP() << "no display";
  }

  void TearDown() override {
    if (user_.is_connected()) user_.wait_until_gone("lockbox");
  }

  static DepthFrame frame_at(std::uint64_t index) {
    DepthFrame frame;
    frame.camera = {64, 48, 60.0, 60.0, 31.5, 23.5};
    frame.depth.assign(std::size_t{64} * 48, static_cast<std::uint16_t>(900 + index % 100));
    frame.index = index;
    return frame;
  }

  const ArticulatedModel model_ = block_model();
  XUser user_;
};

TEST_F(LiveViewTest, TakesFramesAsFastAsTheyComeAndGoesAtAnyTime) {
  LiveView view(model_, "test");
  for (std::uint64_t i = 0; i < 300; ++i) {
    const bool is_known = i % 3 != 0;
    view.show(frame_at(i), is_known ? one_metre_away() : unknown_configuration(model_.tree), "");
  }
  EXPECT_TRUE(view.is_open());
}

TEST_F(LiveViewTest, GoesOnWithoutAWindowAfterTheUserHasClosedIt) {
  LiveView view(model_, "test");
  user_.find_window("lockbox - test");
  view.show(frame_at(0), one_metre_away(), "first");
  user_.press("e");
  user_.close();
  // A busy machine draws a frame in seconds.
  for (int waits = 0; waits < 6000 && view.is_open(); ++waits) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_FALSE(view.is_open());
  view.show(frame_at(1), one_metre_away(), "second");
}

}  // namespace
}  // namespace lockbox
