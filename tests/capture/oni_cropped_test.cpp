// SPDX-License-Identifier: BSD-3-Clause
// Depth that the device crops, recorded by OpenNI2's own recorder and live.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lockbox/capture/live_device.hpp"
#include "lockbox/capture/oni_player.hpp"
#include "lockbox/capture/oni_validator.hpp"
#include "lockbox/capture/oni_writer.hpp"
#include "lockbox/core/error.hpp"
#include "recorded_streams.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr int kRecorded = 6;
constexpr Region kRegion{5, 3, 20, 17};
const Streams kDepth{{openni::SENSOR_DEPTH}, false, false};
const Streams kCroppedDepth{{openni::SENSOR_DEPTH}, false, false, kRegion};

/// What is outside of the region, which is in the un-mirrored image, has no measurement.
std::vector<std::uint16_t> cropped_depth(std::uint64_t number, const Region& region) {
  const PinholeCamera camera = tiny_camera();
  std::vector<std::uint16_t> depth = synthetic_frame(number, camera).depth;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      if (u < region.x || u >= region.x + region.width || v < region.y ||
          v >= region.y + region.height) {
        depth[static_cast<std::size_t>(v * camera.width + u)] = 0;
      }
    }
  }
  return depth;
}

void expect_cropped_frames(const std::filesystem::path& file, const Region& region) {
  OniPlayer player(file);
  ASSERT_GE(player.frame_count(), kRecorded / 2U);
  DepthFrame frame;
  for (std::uint64_t number = kRecorded - *player.frame_count(); number < kRecorded; ++number) {
    ASSERT_TRUE(player.next(frame));
    EXPECT_EQ(frame.camera, tiny_camera());
    EXPECT_EQ(frame.depth, cropped_depth(number, region)) << number;
  }
  EXPECT_FALSE(player.next(frame));
}

TEST(CroppedRecording, DepthComesBackInItsPlaceOfTheWholeImage) {
  const TemporaryFolder folder;
  record_streams(folder / "a.oni", kCroppedDepth, kRecorded, tiny_camera());
  EXPECT_TRUE(validate_oni(folder / "a.oni").is_plain);
  expect_cropped_frames(folder / "a.oni", kRegion);
}

TEST(CroppedRecording, MirroredDepthIsTurnedRoundWithItsPlace) {
  const TemporaryFolder folder;
  record_streams(folder / "a.oni", {{openni::SENSOR_DEPTH}, false, true, kRegion}, kRecorded,
                 tiny_camera());
  expect_cropped_frames(folder / "a.oni", {32 - 5 - 20, 3, 20, 17});
}

TEST(CroppedRecording, OtherStreamsMayBeCroppedToo) {
  const TemporaryFolder folder;
  const Streams streams{
      {openni::SENSOR_IR, openni::SENSOR_COLOR, openni::SENSOR_DEPTH}, false, false, kRegion};
  record_streams(folder / "a.oni", streams, kRecorded, tiny_camera());
  expect_cropped_frames(folder / "a.oni", kRegion);
}

TEST(CroppedRecording, IsFollowedWithoutItsEndToo) {
  const TemporaryFolder folder;
  record_streams(folder / "a.oni", kCroppedDepth, kRecorded, tiny_camera());
  const OniPayload last = validate_oni(folder / "a.oni").payloads.back();
  std::filesystem::resize_file(folder / "a.oni", last.offset + last.size);
  EXPECT_TRUE(validate_oni(folder / "a.oni").is_cut_off);
  expect_cropped_frames(folder / "a.oni", kRegion);
}

TEST(CroppedRecording, IsRecordedAgainAsAWholeImage) {
  const TemporaryFolder folder;
  record_streams(folder / "a.oni", kCroppedDepth, kRecorded, tiny_camera());
  record((folder / "a.oni").string(), folder / "b.oni", {[] { return false; }});
  const OniImage image = validate_oni(folder / "b.oni").images.front();
  EXPECT_EQ(image.recorded_width, 32);
  expect_cropped_frames(folder / "b.oni", kRegion);
}

/// Records three frames, and as many after another cropping was set.
void record_with_change(const std::filesystem::path& file, const Streams& streams,
                        const Region& later) {
  record_streams(file, streams, kRecorded, tiny_camera(), [later](StreamsOfDevice& attached) {
    attached.allow_frames(kRecorded / 2);
    attached.read_through(kRecorded / 2);
    attached.crop(later);
    attached.allow_frames(kRecorded);
  });
}

// OpenNI2's recorder does not write such changes, or those of the resolution, down.
TEST(CroppedRecording, PlaysUpToAChangeThatTheFileDoesNotTell) {
  const TemporaryFolder folder;
  for (const Streams& streams : {kDepth, kCroppedDepth}) {
    record_with_change(folder / "a.oni", streams, {1, 2, 18, 16});
    std::vector<std::string> warnings;
    SourceOptions options;
    options.warn = [&](const std::string& text) { warnings.push_back(text); };
    OniPlayer player(folder / "a.oni", options);
    const std::size_t change = *player.frame_count() - kRecorded / 2;
    DepthFrame frame;
    std::size_t count = 0;
    while (player.next(frame)) {
      EXPECT_EQ(frame.depth, cropped_depth(kRecorded / 2 - change + count,
                                           streams.cropping.value_or(Region{0, 0, 32, 24})));
      ++count;
    }
    EXPECT_EQ(count, change);
    EXPECT_EQ(player.frame_count(), change);
    EXPECT_THAT(warnings,
                ElementsAre(HasSubstr("from frame " + std::to_string(change + 1) +
                                      " on the depth images have 288 pixels instead of ")));
  }
}

TEST(CroppedRecording, IsRefusedIfNoImageIsWhatTheFileTells) {
  const TemporaryFolder folder;
  record_streams(folder / "a.oni", kDepth, kRecorded, tiny_camera(), [](StreamsOfDevice& attached) {
    attached.crop(kRegion);
    attached.allow_frames(kRecorded);
  });
  EXPECT_THAT([&] { OniPlayer(folder / "a.oni"); },
              ::testing::ThrowsMessage<InputError>(HasSubstr("340 pixels instead of 768")));
}

TEST(CroppedDevice, DepthComesInItsPlaceOfTheWholeImage) {
  const TemporaryFolder folder;
  VirtualDepthServer server(folder / "camera");
  StreamsOfDevice::require(openni::OpenNI::initialize());
  const auto sent = std::async(std::launch::async, [&server] {
    VirtualDepthSender sender = server.accept(tiny_camera(), 30, 0.001F);
    try {
      while (true) sender.send(synthetic_frame(7, tiny_camera()));
    } catch (const DeviceError&) {
      // Its users have closed it.
    }
  });
  openni::Device shared;
  StreamsOfDevice::require(shared.open(server.uri().c_str()));
  const StreamsOfDevice cropped(shared, kCroppedDepth);
  LiveDevice device(server.uri());
  DepthFrame frame;
  ASSERT_TRUE(device.next(frame));
  EXPECT_EQ(frame.camera, tiny_camera());
  EXPECT_EQ(frame.depth, cropped_depth(7, kRegion));
}

}  // namespace
}  // namespace lockbox
