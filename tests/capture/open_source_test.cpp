// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <future>
#include <thread>

#include "lockbox/capture/camera_info.hpp"
#include "lockbox/capture/depth_folder.hpp"
#include "lockbox/capture/frame_grabber.hpp"
#include "lockbox/capture/frame_source.hpp"
#include "lockbox/capture/oni_player.hpp"
#include "lockbox/capture/oni_writer.hpp"
#include "lockbox/core/error.hpp"
#include "synthetic_frames.hpp"

namespace lockbox {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

void write_recording(const std::filesystem::path& file, std::uint64_t count) {
  OniWriter writer(file, small_camera(), 30);
  for (std::uint64_t number = 0; number < count; ++number) {
    writer.write(synthetic_frame(number));
  }
  writer.finish();
}

TEST(OpenSource, WrongSourcesSayWhatIsWrong) {
  const TemporaryFolder folder;
  EXPECT_THAT([] { open_source("/nonexistent/a.oni"); },
              ThrowsMessage<InputError>(HasSubstr("/nonexistent/a.oni: no such file or folder")));
  EXPECT_THAT([&] { open_source(folder.path().string()); },
              ThrowsMessage<InputError>(HasSubstr("neither a depth.txt")));
}

TEST(OpenSource, TwoPlayersOfOneFileDoNotDisturbEachOther) {
  const TemporaryFolder folder;
  write_recording(folder / "a.oni", 4);
  const std::unique_ptr<FrameSource> one = open_source((folder / "a.oni").string());
  const std::unique_ptr<FrameSource> two = open_source((folder / "a.oni").string());
  DepthFrame frame;
  for (std::uint64_t number = 0; number < 4; ++number) {
    ASSERT_TRUE(one->next(frame));
    EXPECT_EQ(frame.depth, synthetic_frame(number).depth);
    ASSERT_TRUE(two->next(frame));
    EXPECT_EQ(frame.depth, synthetic_frame(number).depth);
  }
}

TEST(OpenSource, AGivenCameraReplacesTheRecordings) {
  const TemporaryFolder folder;
  write_recording(folder / "a.oni", 1);
  SourceOptions options;
  options.camera = PinholeCamera{160, 120, 140.0, 141.0, 78.0, 61.0};
  DepthFrame frame;
  ASSERT_TRUE(open_source((folder / "a.oni").string(), options)->next(frame));
  EXPECT_EQ(frame.camera, *options.camera);
  EXPECT_EQ(frame.depth, synthetic_frame(0).depth);
  options.camera->width = 320;
  EXPECT_THROW(open_source((folder / "a.oni").string(), options), InputError);
}

TEST(OpenSource, RealTimeKeepsThePaceOfTheRecording) {
  const TemporaryFolder folder;
  write_recording(folder / "a.oni", 5);
  SourceOptions options;
  options.realtime = true;
  const std::unique_ptr<FrameSource> source = open_source((folder / "a.oni").string(), options);
  DepthFrame frame;
  EXPECT_TRUE(source->is_realtime());
  EXPECT_FALSE(open_source((folder / "a.oni").string())->is_realtime());
  ASSERT_TRUE(source->next(frame));
  const auto start = std::chrono::steady_clock::now();
  while (source->next(frame)) {
  }
  EXPECT_EQ(frame.index, 4U);
  EXPECT_GE(std::chrono::steady_clock::now() - start, 130ms);
}

TEST(OpenSource, RealTimeDropsWhatASlowConsumerMisses) {
  const TemporaryFolder folder;
  write_recording(folder / "a.oni", 12);
  SourceOptions options;
  options.realtime = true;
  const std::unique_ptr<FrameSource> source = open_source((folder / "a.oni").string(), options);
  DepthFrame frame;
  ASSERT_TRUE(source->next(frame));
  std::this_thread::sleep_for(150ms);
  ASSERT_TRUE(source->next(frame));
  EXPECT_GE(frame.index, 4U);
}

/// Two frames, an hour apart.
void write_recording_with_a_pause(const std::filesystem::path& folder) {
  DepthFolderWriter writer(folder);
  DepthFrame frame = synthetic_frame(0);
  writer.write(frame);
  frame.stamp = 3600.0;
  writer.write(frame);
}

TEST(OpenSource, RealTimeDoesNotWaitThroughAPauseWhenToldToStop) {
  const TemporaryFolder folder;
  write_recording_with_a_pause(folder / "depth");
  const auto start = std::chrono::steady_clock::now();
  SourceOptions options;
  options.realtime = true;
  options.stop = [start] { return std::chrono::steady_clock::now() - start > 150ms; };
  const std::unique_ptr<FrameSource> source = open_source((folder / "depth").string(), options);
  DepthFrame frame;
  ASSERT_TRUE(source->next(frame));
  EXPECT_FALSE(source->next(frame));
  EXPECT_LT(std::chrono::steady_clock::now() - start, 2s);
}

TEST(OpenSource, AGrabberThatWaitsThroughAPauseStops) {
  const TemporaryFolder folder;
  write_recording_with_a_pause(folder / "depth");
  SourceOptions options;
  options.realtime = true;
  FrameGrabber grabber((folder / "depth").string(), options);
  std::promise<void> first;
  grabber.registerCallback<FrameGrabber::FrameCallback>(
      [&first](const std::shared_ptr<const DepthFrame>&) { first.set_value(); });
  std::atomic<bool> ended{false};
  grabber.registerCallback<FrameGrabber::EndCallback>(
      [&ended](const std::string&) { ended = true; });
  grabber.start();
  first.get_future().wait();
  const auto start = std::chrono::steady_clock::now();
  grabber.stop();
  EXPECT_LT(std::chrono::steady_clock::now() - start, 1s);
  EXPECT_FALSE(ended);  // not by itself
}

}  // namespace
}  // namespace lockbox
