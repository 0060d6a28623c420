// SPDX-License-Identifier: BSD-3-Clause
// Recordings of depth, colour and infrared, as OpenNI2's own tools make them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "lockbox/capture/oni_player.hpp"
#include "lockbox/capture/oni_validator.hpp"
#include "recorded_streams.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

constexpr int kFrames = 6;

/// Those from `first` on, one after the other; a recording may begin late.
void expect_synthetic_frames(const std::filesystem::path& file, std::uint64_t first) {
  OniPlayer player(file);
  DepthFrame frame;
  for (std::uint64_t number = first; number < std::uint64_t{kFrames}; ++number) {
    ASSERT_TRUE(player.next(frame));
    EXPECT_EQ(frame.depth, synthetic_frame(number, tiny_camera()).depth) << number;
    EXPECT_NEAR(frame.stamp, 0.033333 * static_cast<double>(number - first), 1e-6);
  }
}

std::string name_of(const ::testing::TestParamInfo<Streams>& info) {
  std::string name;
  for (const openni::SensorType type : info.param.order) {
    name += type == openni::SENSOR_DEPTH ? 'D' : type == openni::SENSOR_COLOR ? 'C' : 'I';
  }
  return name + (info.param.lossy ? "_lossy" : "") + (info.param.mirrored ? "_mirrored" : "");
}

std::vector<Streams> all_streams() {
  constexpr auto D = openni::SENSOR_DEPTH;
  constexpr auto C = openni::SENSOR_COLOR;
  constexpr auto I = openni::SENSOR_IR;
  std::vector<Streams> all;
  for (const std::vector<openni::SensorType>& order :
       std::vector<std::vector<openni::SensorType>>{{D},
                                                    {D, C},
                                                    {C, D},
                                                    {D, I},
                                                    {I, D},
                                                    {D, C, I},
                                                    {D, I, C},
                                                    {C, D, I},
                                                    {I, D, C},
                                                    {C, I, D},
                                                    {I, C, D}}) {
    all.push_back({order, false, false});
    all.push_back({order, true, true});
  }
  all.push_back({{D, C}, false, true});
  all.push_back({{D, C}, true, false});
  return all;
}

class RecordedStreams : public ::testing::TestWithParam<Streams> {
 protected:
  TemporaryFolder folder_;
};

TEST_P(RecordedStreams, DepthComesBackBitForBit) {
  record_streams(folder_ / "a.oni", GetParam(), kFrames, tiny_camera());
  const OniRecording recording = validate_oni(folder_ / "a.oni");
  EXPECT_TRUE(recording.is_plain);
  EXPECT_EQ(recording.images.front().mirrored, GetParam().mirrored);
  ASSERT_GE(recording.frame_count, kFrames / 2U);
  ASSERT_LE(recording.frame_count, std::size_t{kFrames});
  expect_synthetic_frames(folder_ / "a.oni", kFrames - recording.frame_count);
}

TEST_P(RecordedStreams, DepthComesBackFromARecordingOfTheRecording) {
  record_streams(folder_ / "a.oni", GetParam(), kFrames, tiny_camera());
  const std::size_t frames = validate_oni(folder_ / "a.oni").frame_count;
  Streams reversed = GetParam();
  std::reverse(reversed.order.begin(), reversed.order.end());
  record_again(folder_ / "a.oni", folder_ / "b.oni", reversed, static_cast<int>(frames));
  const OniRecording recording = validate_oni(folder_ / "b.oni");
  EXPECT_EQ(recording.images.front().mirrored, GetParam().mirrored);
  ASSERT_GE(recording.frame_count, frames);  // the player begins anew before it is stopped
  expect_synthetic_frames(folder_ / "b.oni", kFrames - frames);
}

TEST(DamagedColour, DoesNotStopDepth) {
  const TemporaryFolder folder;
  const Streams streams{{openni::SENSOR_COLOR, openni::SENSOR_DEPTH}, true, false};
  record_streams(folder / "a.oni", streams, kFrames, tiny_camera());
  const OniRecording recording = validate_oni(folder / "a.oni");
  for (const OniPayload& payload : recording.payloads) {
    if (payload.depth) {
      continue;
    }
    std::filesystem::copy_file(folder / "a.oni", folder / "damaged.oni",
                               std::filesystem::copy_options::overwrite_existing);
    std::fstream file(folder / "damaged.oni", std::ios::binary | std::ios::in | std::ios::out);
    file.seekp(static_cast<std::streamoff>(payload.offset) + 4);
    file.write("\xff\xff\xff\xff\xff", 5);
    file.close();
    OniPayloadChecker checker(validate_oni(folder / "damaged.oni"));
    EXPECT_FALSE(checker.check_through(kFrames)) << payload.frame;
    expect_synthetic_frames(folder / "damaged.oni", kFrames - recording.frame_count);
  }
}

INSTANTIATE_TEST_SUITE_P(All, RecordedStreams, ::testing::ValuesIn(all_streams()), name_of);

}  // namespace
}  // namespace lockbox
