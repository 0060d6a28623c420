// SPDX-License-Identifier: BSD-3-Clause
// The real OpenNI2 runtime with the virtual device driver.
#include "lockbox/capture/live_device.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <future>
#include <thread>

#include "lockbox/capture/oni_player.hpp"
#include "lockbox/capture/oni_writer.hpp"
#include "lockbox/capture/virtual_depth.hpp"
#include "lockbox/core/error.hpp"
#include "synthetic_frames.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// A camera that delivers synthetic frames until it is unplugged.
class VirtualCamera {
 public:
  explicit VirtualCamera(std::chrono::milliseconds period)
      : server_(folder_ / "camera"), thread_([this, period] { run(period); }) {}
  ~VirtualCamera() {
    unplug();
    server_.close();
    thread_.join();
  }
  VirtualCamera(const VirtualCamera&) = delete;
  VirtualCamera& operator=(const VirtualCamera&) = delete;

  std::string uri() const { return server_.uri(); }
  void unplug() { plugged_ = false; }
  void stall() { stalled_ = true; }

 private:
  void run(std::chrono::milliseconds period) {
    try {
      VirtualDepthSender sender = server_.accept(small_camera(), 100, 0.001F);
      for (std::uint64_t number = 0; plugged_; ++number) {
        if (!stalled_) {
          sender.try_send(synthetic_frame(number));
        }
        std::this_thread::sleep_for(period);
      }
    } catch (const DeviceError&) {
      // closed
    }
  }

  TemporaryFolder folder_;
  std::atomic<bool> plugged_{true};
  std::atomic<bool> stalled_{false};
  VirtualDepthServer server_;
  std::thread thread_;
};

std::uint64_t number_of(const DepthFrame& frame) {
  return static_cast<std::uint64_t>(std::llround(frame.stamp / 0.033333));
}

TEST(LiveDevice, FramesArriveBitForBit) {
  const VirtualCamera camera(5ms);
  LiveDevice device(camera.uri());
  EXPECT_EQ(device.frame_count(), std::nullopt);
  DepthFrame frame;
  std::uint64_t last = 0;
  for (int i = 0; i < 10; ++i) {
    ASSERT_TRUE(device.next(frame));
    const DepthFrame expected = synthetic_frame(number_of(frame));
    EXPECT_EQ(frame.depth, expected.depth);
    EXPECT_EQ(frame.camera, expected.camera);
    EXPECT_TRUE(i == 0 ? frame.index == 0 : frame.index > last);
    last = frame.index;
  }
}

TEST(LiveDevice, ASlowConsumerGetsTheNewestFrame) {
  const VirtualCamera camera(2ms);
  LiveDevice device(camera.uri());
  DepthFrame first;
  DepthFrame second;
  ASSERT_TRUE(device.next(first));
  std::this_thread::sleep_for(200ms);
  ASSERT_TRUE(device.next(second));
  EXPECT_GT(second.index, first.index + 5);
  EXPECT_EQ(device.faults().dropped, second.index - first.index - 1);
}

TEST(LiveDevice, UnpluggingIsNoticed) {
  VirtualCamera camera(2ms);
  LiveDevice device(camera.uri());
  DepthFrame frame;
  ASSERT_TRUE(device.next(frame));
  camera.unplug();
  EXPECT_THAT(
      [&] {
        while (device.next(frame)) {
        }
      },
      ThrowsMessage<DeviceError>(HasSubstr("was unplugged")));
}

TEST(LiveDevice, WaitingForAStalledDeviceCanBeEnded) {
  VirtualCamera camera(2ms);
  std::atomic<bool> stop{false};
  SourceOptions options;
  options.stop = [&stop] { return stop.load(); };
  LiveDevice device(camera.uri(), options);
  DepthFrame frame;
  ASSERT_TRUE(device.next(frame));
  camera.stall();
  const auto later = std::async(std::launch::async, [&stop] {
    std::this_thread::sleep_for(100ms);
    stop = true;
  });
  const auto start = std::chrono::steady_clock::now();
  while (device.next(frame)) {
  }
  EXPECT_LT(std::chrono::steady_clock::now() - start, LOCKBOX_SLOWDOWN * 1s);
}

/// Exit status of a process that opens the camera without naming it.
[[noreturn]] void open_unnamed(const VirtualCamera& camera) {
  const std::string uri = camera.uri();
  ::setenv("LOCKBOX_VIRTUAL_DEPTH", uri.substr(uri.find(':') + 1).c_str(), 1);
  const std::unique_ptr<FrameSource> device = open_source("openni2:");
  DepthFrame frame;
  const bool found = device->description().find(uri) != std::string::npos && device->next(frame);
  std::_Exit(found ? 0 : 1);
}

TEST(LiveDevice, ADeviceIsFoundWithoutNamingItIfTheEnvironmentNamesIt) {
  // In a process of its own, because OpenNI2 looks for devices when it starts.
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const VirtualCamera camera(5ms);
  EXPECT_EXIT(open_unnamed(camera), ::testing::ExitedWithCode(0), "");
}

/// Ends the process with 0 if there is no device, although a recording is open.
[[noreturn]] void open_nothing(const std::filesystem::path& recording) {
  const OniPlayer player(recording);
  try {
    open_source("openni2:");
  } catch (const DeviceError& error) {
    std::fputs(error.what(), stderr);
    std::_Exit(0);
  }
  std::_Exit(1);
}

TEST(LiveDevice, WithoutDevicesThereIsNone) {
  // In a process of its own, because OpenNI2 remembers the virtual devices of other tests.
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const TemporaryFolder folder;
  OniWriter writer(folder / "a.oni", small_camera(), 30);
  writer.write(synthetic_frame(0));
  writer.finish();
  EXPECT_EXIT(open_nothing(folder / "a.oni"), ::testing::ExitedWithCode(0),
              "no OpenNI2 device is connected");
}

TEST(LiveDevice, UnknownDevicesAreDeviceErrors) {
  EXPECT_THAT([] { open_source("openni2:no/such@device"); },
              ThrowsMessage<DeviceError>(HasSubstr("no/such@device: no such OpenNI2 device")));
  EXPECT_THAT([] { open_source("openni2:virtual-depth:/nonexistent/socket"); },
              ThrowsMessage<DeviceError>(HasSubstr("nobody offers frames")));
}

TEST(Record, ALiveDeviceIsRecordedBitForBit) {
  const TemporaryFolder folder;
  const VirtualCamera camera(5ms);
  const auto deadline = std::chrono::steady_clock::now() + LOCKBOX_SLOWDOWN * 300ms;
  const std::size_t count =
      record("openni2:" + camera.uri(), folder / "a.oni",
             {[deadline] { return std::chrono::steady_clock::now() > deadline; }});
  EXPECT_GT(count, 5U);
  OniPlayer player(folder / "a.oni");
  DepthFrame frame;
  ASSERT_TRUE(player.next(frame));
  // The recording's stamps begin at 0: find out which frame was the first.
  std::uint64_t first = 0;
  while (first < 1000 && synthetic_frame(first).depth != frame.depth) {
    ++first;
  }
  ASSERT_LT(first, 1000U);
  while (player.next(frame)) {
    EXPECT_EQ(frame.depth, synthetic_frame(first + number_of(frame)).depth) << frame.index;
  }
}

TEST(Record, UnpluggingEndsTheRecording) {
  const TemporaryFolder folder;
  VirtualCamera camera(2ms);
  auto unplug = std::async(std::launch::async, [&camera] {
    std::this_thread::sleep_for(LOCKBOX_SLOWDOWN * 200ms);
    camera.unplug();
  });
  EXPECT_GT(record("openni2:" + camera.uri(), folder / "a.oni", {[] { return false; }}), 5U);
}

TEST(Record, ARecordingIsRecordedAgainBitForBit) {
  const TemporaryFolder folder;
  OniWriter writer(folder / "a.oni", small_camera(), 30);
  for (std::uint64_t number = 0; number < 5; ++number) {
    writer.write(synthetic_frame(number));
  }
  writer.finish();
  const auto never = [] { return false; };
  EXPECT_EQ(record((folder / "a.oni").string(), folder / "b.oni", {never}), 5U);
  OniPlayer player(folder / "b.oni");
  DepthFrame frame;
  for (std::uint64_t number = 0; number < 5; ++number) {
    ASSERT_TRUE(player.next(frame));
    EXPECT_EQ(frame.depth, synthetic_frame(number).depth);
    EXPECT_EQ(number_of(frame), number);
    EXPECT_EQ(frame.camera, small_camera());
  }
  EXPECT_EQ(record((folder / "a.oni").string(), folder / "c.oni", {[] { return true; }}), 1U);
}

TEST(Record, EndsAfterSecondsOfTheRecordingHoweverFastItIsRead) {
  const TemporaryFolder folder;
  OniWriter writer(folder / "a.oni", small_camera(), 30);
  for (std::uint64_t number = 0; number < 9; ++number) {
    writer.write(synthetic_frame(number));
  }
  writer.finish();
  const double step = synthetic_frame(1).stamp - synthetic_frame(0).stamp;
  const RecordingEnd end{[] { return false; }, 3.5 * step};
  EXPECT_EQ(record((folder / "a.oni").string(), folder / "b.oni", end), 4U);
}

TEST(Record, ADeviceIsRecordedForSecondsOfTheClock) {
  const TemporaryFolder folder;
  const VirtualCamera camera(5ms);
  const RecordingEnd end{[] { return false; }, LOCKBOX_SLOWDOWN * 0.3};
  EXPECT_GT(record("openni2:" + camera.uri(), folder / "a.oni", end), 5U);
}

TEST(Record, WrongSourcesAreRefused) {
  const TemporaryFolder folder;
  const auto never = [] { return false; };
  EXPECT_THROW(record("a.oni", folder / "b.oni", {never}), InputError);
  EXPECT_THAT([&] { record("openni2:no/such@device", folder / "b.oni", {never}); },
              ThrowsMessage<DeviceError>(HasSubstr("no such OpenNI2 device")));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace lockbox
