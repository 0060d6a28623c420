// SPDX-License-Identifier: BSD-3-Clause
// Recording: from a live device (the real OpenNI2 runtime with the virtual device driver), and from
// another recording.
#include <gmock/gmock.h>

#include <future>

#include "lockbox/capture/oni_player.hpp"
#include "lockbox/capture/oni_writer.hpp"
#include "lockbox/capture/pcd_folder.hpp"
#include "lockbox/capture/virtual_depth.hpp"
#include "lockbox/core/error.hpp"
#include "synthetic_camera.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

using namespace std::chrono_literals;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// Frames that a device takes of its camera: the recorder gets nearly all of them.
constexpr std::uint64_t kEnough = LOCKBOX_SLOWDOWN * 60;

TEST(Record, ALiveDeviceIsRecordedBitForBit) {
  const TemporaryFolder folder;
  const SyntheticCamera camera(5ms);
  const auto enough = [&camera] { return camera.taken() >= kEnough; };
  const std::size_t count = record("openni2:" + camera.uri(), folder / "a.oni", {enough});
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
  auto recorded = std::async(std::launch::async, [&] {
    return record("openni2:" + camera.uri(), folder / "a.oni", {[] { return false; }});
  });
  while (camera.taken() < kEnough && recorded.wait_for(5ms) != std::future_status::ready) {
  }
  camera.unplug();
  EXPECT_GT(recorded.get(), 5U);
}

TEST(Record, NothingIsLostOfADeviceThatWaitsForItsRecorder) {
  constexpr std::uint64_t kFrames = 40;  // more than the recorder may fall behind
  const TemporaryFolder folder;
  VirtualDepthServer server(folder / "camera");
  const auto sent = std::async(std::launch::async, [&server] {
    VirtualDepthSender sender = server.accept(small_camera(), 30, 0.001F);
    for (std::uint64_t number = 0; number < kFrames; ++number) {
      sender.send(synthetic_frame(number));
    }
  });
  const RecordingEnd end{[] { return false; }, LOCKBOX_SLOWDOWN * 60.0};
  EXPECT_EQ(record("openni2:" + server.uri(), folder / "a.oni", end), kFrames);
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

TEST(Record, ACloudInAnotherUnitIsNamed) {
  const TemporaryFolder folder;
  const PcdFolderWriter writer(folder / "clouds");
  writer.write(synthetic_frame(0));
  DepthFrame fine = synthetic_frame(1);
  fine.metres_per_unit = 0.0001F;
  writer.write(fine);
  const auto never = [] { return false; };
  EXPECT_THAT(
      [&] { record((folder / "clouds").string(), folder / "a.oni", {never}); },
      ThrowsMessage<InputError>(
          AllOf(HasSubstr("clouds/00000000000.033333.pcd: frame 1 has another depth unit (100 um)"),
                HasSubstr("a.oni (1 mm, as "),
                HasSubstr("clouds/00000000000.000000.pcd), which ends before it"))));
}

TEST(Record, WhatNoRecordingHoldsIsRefusedByItsName) {
  const TemporaryFolder folder;
  PinholeCamera camera = small_camera();
  camera.cx += 1.0;
  EXPECT_THAT([&] { OniWriter(folder / "a.oni", camera, 30); },
              ThrowsMessage<InputError>(HasSubstr("a.oni: the camera's principal point (80.5,")));
  EXPECT_THAT([&] { OniWriter(folder / "a.oni", small_camera(), 30, 0.00025F); },
              ThrowsMessage<InputError>(HasSubstr("a.oni: an .oni file holds depths in units")));
  EXPECT_THAT([&] { OniWriter(folder / "a.oni", small_camera(), 30, 0.00025F, "far.pcd"); },
              ThrowsMessage<InputError>(HasSubstr("far.pcd: an .oni file holds depths in units")));
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
