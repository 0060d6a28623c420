// SPDX-License-Identifier: BSD-3-Clause
// The real OpenNI2 runtime with the virtual device driver.
#include "lockbox/capture/live_device.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <future>
#include <thread>

#include "lockbox/capture/device_list.hpp"
#include "lockbox/capture/oni_player.hpp"
#include "lockbox/capture/oni_writer.hpp"
#include "lockbox/core/error.hpp"
#include "synthetic_frames.hpp"
#include "temporary_folder.hpp"
#include "virtual_camera.hpp"

namespace lockbox {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// Delivers synthetic frames.
class SyntheticCamera : public VirtualCamera {
 public:
  explicit SyntheticCamera(std::chrono::milliseconds period)
      : VirtualCamera([](std::uint64_t number) { return synthetic_frame(number); },
                      static_cast<int>(1000 / period.count())) {}
};

std::uint64_t number_of(const DepthFrame& frame) {
  return static_cast<std::uint64_t>(std::llround(frame.stamp / 0.033333));
}

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
  std::this_thread::sleep_for(200ms);
  ASSERT_TRUE(device.next(second));
  EXPECT_GT(second.index, first.index + 5);
  EXPECT_EQ(device.faults().dropped, second.index - first.index - 1);
}

/// Takes what the device says of outages.
struct Told {
  std::vector<std::string> texts;
  SourceOptions options(double patience) {
    SourceOptions options;
    options.patience = patience;
    options.warn = [this](const std::string& text) { texts.push_back(text); };
    return options;
  }
};

void take_all(LiveDevice& device) {
  DepthFrame frame;
  while (device.next(frame)) {
  }
}

TEST(LiveDevice, ThatIsUnpluggedForGoodFails) {
  SyntheticCamera camera(2ms);
  Told told;
  LiveDevice device(camera.uri(), told.options(0.3));
  DepthFrame frame;
  ASSERT_TRUE(device.next(frame));
  camera.unplug();
  EXPECT_THAT([&] { take_all(device); },
              ThrowsMessage<DeviceError>(HasSubstr("was unplugged, and did not come back")));
  EXPECT_THAT(told.texts, ElementsAre(HasSubstr("was unplugged; waiting for it, 0.3 s at most")));
}

TEST(LiveDevice, ThatStallsForGoodFails) {
  SyntheticCamera camera(2ms);
  Told told;
  LiveDevice device(camera.uri(), told.options(0.3));
  DepthFrame frame;
  ASSERT_TRUE(device.next(frame));
  camera.stall();
  EXPECT_THAT([&] { take_all(device); },
              ThrowsMessage<DeviceError>(HasSubstr("has delivered no frame for 0.3 s; check")));
}

/// Goes on where it was: with the next number, and a later stamp.
void expect_to_go_on(LiveDevice& device, const DepthFrame& before) {
  DepthFrame frame;
  ASSERT_TRUE(device.next(frame));
  EXPECT_EQ(frame.index, before.index + 1);
  EXPECT_GT(frame.stamp, before.stamp);
}

/// The last frame that is there before the device is away or silent.
DepthFrame last_frame(LiveDevice& device) {
  DepthFrame frame;
  std::uint64_t count = 0;
  do {
    device.next(frame);
  } while (++count < 3);
  return frame;
}

TEST(LiveDevice, ThatWasUnpluggedGoesOn) {
  SyntheticCamera camera(20ms);
  Told told;
  LiveDevice device(camera.uri(), told.options(LOCKBOX_SLOWDOWN * 10.0));
  const DepthFrame before = last_frame(device);
  camera.unplug();
  const auto replug = std::async(std::launch::async, [&camera] {
    std::this_thread::sleep_for(300ms);
    camera.plug_in();
  });
  expect_to_go_on(device, before);
  EXPECT_THAT(told.texts, ElementsAre(HasSubstr("was unplugged; waiting"),
                                      HasSubstr("delivers frames again, after")));
  EXPECT_EQ(device.faults().outages, 1U);
  EXPECT_EQ(device.faults().dropped, 0U);
}

TEST(LiveDevice, ThatHasStalledGoesOn) {
  SyntheticCamera camera(20ms);
  Told told;
  LiveDevice device(camera.uri(), told.options(LOCKBOX_SLOWDOWN * 10.0));
  const DepthFrame before = last_frame(device);
  camera.stall();
  const auto resume = std::async(std::launch::async, [&camera] {
    std::this_thread::sleep_for(1300ms);
    camera.go_on();
  });
  DepthFrame frame;
  while (told.texts.empty()) ASSERT_TRUE(device.next(frame));
  EXPECT_GT(frame.index, before.index);
  EXPECT_EQ(frame.depth, synthetic_frame(number_of(frame)).depth);
  EXPECT_THAT(told.texts, ElementsAre(HasSubstr("no frame for 1 s; waiting"),
                                      HasSubstr("delivers frames again, after 1")));
  EXPECT_EQ(device.faults().outages, 1U);
}

TEST(LiveDevice, ThatWasUnpluggedIsFoundUnderAnotherName) {
  // As USB devices are, which have a new number each time.
  SyntheticCamera camera(20ms);
  Told told;
  LiveDevice device(camera.uri(), told.options(LOCKBOX_SLOWDOWN * 10.0));
  const DepthFrame before = last_frame(device);
  camera.unplug();
  const SyntheticCamera again(20ms);
  ASSERT_EQ(list_devices({again.uri()}).back().problem, std::nullopt);
  expect_to_go_on(device, before);
}

TEST(LiveDevice, WaitingForAStalledDeviceCanBeEnded) {
  SyntheticCamera camera(2ms);
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

TEST(Record, ALiveDeviceIsRecordedBitForBit) {
  const TemporaryFolder folder;
  const SyntheticCamera camera(5ms);
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
  SyntheticCamera camera(2ms);
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
  const SyntheticCamera camera(5ms);
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
