// SPDX-License-Identifier: BSD-3-Clause
// Outages of a live device: it is unplugged or stalls, and comes back or does not. The real OpenNI2
// runtime with the virtual device driver.
#include <gmock/gmock.h>

#include <future>
#include <thread>

#include "lockbox/capture/device_list.hpp"
#include "lockbox/capture/live_device.hpp"
#include "lockbox/core/error.hpp"
#include "synthetic_camera.hpp"

namespace lockbox {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

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

TEST(LiveOutage, ADeviceThatIsUnpluggedForGoodFails) {
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

TEST(LiveOutage, ADeviceThatStallsForGoodFails) {
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

TEST(LiveOutage, ADeviceThatWasUnpluggedGoesOn) {
  SyntheticCamera camera(20ms);
  Told told;
  LiveDevice device(camera.uri(), told.options(LOCKBOX_SLOWDOWN * 10.0));
  const DepthFrame before = last_frame(device);
  const std::size_t dropped = device.faults().dropped;
  camera.unplug();
  const auto replug = std::async(std::launch::async, [&camera] {
    std::this_thread::sleep_for(300ms);
    camera.plug_in();
  });
  expect_to_go_on(device, before);
  EXPECT_THAT(told.texts, ElementsAre(HasSubstr("was unplugged; waiting"),
                                      HasSubstr("delivers frames again, after")));
  EXPECT_EQ(device.faults().outages, 1U);
  EXPECT_EQ(device.faults().dropped, dropped);
}

TEST(LiveOutage, ADeviceThatHasStalledGoesOn) {
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

TEST(LiveOutage, ADeviceThatWasUnpluggedIsFoundUnderAnotherName) {
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

TEST(LiveOutage, WaitingForAStalledDeviceCanBeEnded) {
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

}  // namespace
}  // namespace lockbox
