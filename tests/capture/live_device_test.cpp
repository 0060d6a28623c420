// SPDX-License-Identifier: BSD-3-Clause
// The real OpenNI2 runtime with the virtual device driver.
#include "lockbox/capture/live_device.hpp"

#include <gmock/gmock.h>

#include <thread>

#include "lockbox/capture/oni_player.hpp"
#include "lockbox/capture/oni_writer.hpp"
#include "lockbox/core/error.hpp"
#include "synthetic_camera.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

TEST(LiveDevice, FramesArriveBitForBit) {
  const SyntheticCamera camera(5ms);
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
  const SyntheticCamera camera(2ms);
  LiveDevice device(camera.uri());
  DepthFrame first;
  DepthFrame second;
  ASSERT_TRUE(device.next(first));
  std::this_thread::sleep_for(LOCKBOX_SLOWDOWN * 200ms);
  ASSERT_TRUE(device.next(second));
  EXPECT_GT(second.index, first.index + 5);
  EXPECT_EQ(device.faults().dropped, second.index - first.index - 1);
}

TEST(LiveDevice, SeveralDevicesAreReadSideBySideEachByItsUri) {
  const SyntheticCamera left(5ms);
  const VirtualCamera right([](std::uint64_t n) { return synthetic_frame(n, tiny_camera()); }, 60);
  const std::unique_ptr<FrameSource> sources[] = {open_source("openni2:" + left.uri()),
                                                  open_source("openni2:" + right.uri())};
  DepthFrame frame;
  for (int i = 0; i < 5; ++i) {
    ASSERT_TRUE(sources[0]->next(frame));
    EXPECT_EQ(frame.depth, synthetic_frame(number_of(frame)).depth);
    ASSERT_TRUE(sources[1]->next(frame));
    EXPECT_EQ(frame.depth, synthetic_frame(number_of(frame), tiny_camera()).depth);
  }
}

/// Exit status of a process that opens the camera without naming it.
[[noreturn]] void open_unnamed(const SyntheticCamera& camera) {
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
  const SyntheticCamera camera(5ms);
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

}  // namespace
}  // namespace lockbox
