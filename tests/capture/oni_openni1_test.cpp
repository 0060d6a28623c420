// SPDX-License-Identifier: BSD-3-Clause
// Recordings that OpenNI 1 has made.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ostream>

#include "lockbox/capture/oni_player.hpp"
#include "lockbox/capture/oni_validator.hpp"
#include "synthetic_frames.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

constexpr std::uint64_t kFrames = 4;

struct Recorded {
  const char* name;
  const char* nodes;
  const char* mirroring = "straight";
  bool aborted = false;
  bool plain = true;
};

void PrintTo(const Recorded& recorded, std::ostream* out) {
  *out << recorded.nodes;
}

std::string name_of(const ::testing::TestParamInfo<Recorded>& info) {
  return info.param.name;
}

class RecordedByOpenNi1 : public ::testing::TestWithParam<Recorded> {};

std::vector<bool> mirrored_frames(const std::string& mirroring) {
  const bool first = mirroring == "mirrored";
  const bool last = mirroring != "straight";
  return {first, first, last, last};
}

TEST_P(RecordedByOpenNi1, DepthComesBackBitForBit) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "a.oni";
  const std::string command = std::string(LOCKBOX_OPENNI1_RECORDER) + " " + file.string() + " " +
                              std::to_string(kFrames) +
                              (GetParam().aborted ? " abort" : " finish") + " " +
                              GetParam().mirroring + " " + GetParam().nodes;
  ASSERT_EQ(std::system(command.c_str()), 0) << command;
  const OniRecording recording = validate_oni(file);
  const std::vector<bool> mirrored = mirrored_frames(GetParam().mirroring);
  EXPECT_EQ(recording.is_cut_off, GetParam().aborted);
  EXPECT_EQ(recording.is_plain, GetParam().plain);
  OniPlayer player(file);
  ASSERT_EQ(player.frame_count(), kFrames);
  DepthFrame frame;
  for (std::uint64_t number = 0; number < kFrames; ++number) {
    ASSERT_TRUE(player.next(frame));
    DepthFrame expected = synthetic_frame(number, frame.camera);
    EXPECT_EQ(recording.images[number].mirrored, mirrored[number]);
    if (mirrored[number]) {  // the recorder takes what the node says it has made
      for (auto row = expected.depth.begin(); row != expected.depth.end();
           row += frame.camera.width) {
        std::reverse(row, row + frame.camera.width);
      }
    }
    EXPECT_EQ(frame.depth, expected.depth) << number;
    EXPECT_NEAR(frame.stamp, expected.stamp, 2e-6);
    EXPECT_NEAR(frame.camera.fx, 16.0 / std::tan(0.49), 1e-3);
  }
  EXPECT_FALSE(player.next(frame));
}

/// A recording of a depth stream that changes from the third frame on.
OniRecording record_changing(const std::filesystem::path& file, const std::string& manner) {
  const std::string command = std::string(LOCKBOX_OPENNI1_RECORDER) + " " + file.string() + " " +
                              std::to_string(kFrames) + " finish " + manner + " depth:16zT";
  EXPECT_EQ(std::system(command.c_str()), 0) << command;
  return validate_oni(file);
}

TEST(ChangesByOpenNi1, DepthThatIsCroppedOnTheWayComesBackInItsPlace) {
  const TemporaryFolder folder;
  EXPECT_TRUE(record_changing(folder / "a.oni", "cropped").is_plain);
  OniPlayer player(folder / "a.oni");
  DepthFrame frame;
  for (std::uint64_t number = 0; number < kFrames; ++number) {
    ASSERT_TRUE(player.next(frame));
    DepthFrame expected = synthetic_frame(number, frame.camera);
    for (int v = 0; number >= 2 && v < 24; ++v) {
      for (int u = 0; u < 32; ++u) {
        if (u < 5 || u >= 25 || v < 3 || v >= 20) {
          expected.depth[static_cast<std::size_t>(v * 32 + u)] = 0;
        }
      }
    }
    EXPECT_EQ(frame.depth, expected.depth) << number;
  }
  EXPECT_FALSE(player.next(frame));
}

// The player keeps no more room than the first image takes: larger ones need a copy.
TEST(ChangesByOpenNi1, DepthOfAnotherSizeOnTheWayComesWithItsOwnCamera) {
  const TemporaryFolder folder;
  for (const std::string manner : {"halved", "doubled"}) {
    EXPECT_EQ(record_changing(folder / "a.oni", manner).is_plain, manner == "halved");
    OniPlayer player(folder / "a.oni");
    DepthFrame frame;
    for (std::uint64_t number = 0; number < kFrames; ++number) {
      ASSERT_TRUE(player.next(frame)) << manner;
      const int width = (number < 2) == (manner == "halved") ? 64 : 32;
      EXPECT_EQ(frame.camera.width, width);
      EXPECT_EQ(frame.camera.cx, 0.5 * (width - 1));
      EXPECT_NEAR(frame.camera.fx, 0.5 * width / std::tan(0.49), 1e-3);
      EXPECT_EQ(frame.depth, synthetic_frame(number, frame.camera).depth) << manner << number;
    }
    EXPECT_FALSE(player.next(frame));
  }
}

TEST(ChangesByOpenNi1, WhereACalibrationFitsNoLongerARecordingEnds) {
  const TemporaryFolder folder;
  record_changing(folder / "a.oni", "halved");
  std::vector<std::string> warnings;
  SourceOptions options;
  options.camera = PinholeCamera{64, 48, 60.0, 60.0, 31.5, 23.5};
  options.warn = [&](const std::string& text) { warnings.push_back(text); };
  OniPlayer player(folder / "a.oni", options);
  EXPECT_EQ(player.frame_count(), 2U);
  DepthFrame frame;
  EXPECT_TRUE(player.next(frame));
  EXPECT_TRUE(player.next(frame));
  EXPECT_FALSE(player.next(frame));
  EXPECT_THAT(warnings, ::testing::ElementsAre(
                            ::testing::HasSubstr("from frame 3 on the depth images are 32x24")));
}

INSTANTIATE_TEST_SUITE_P(
    All, RecordedByOpenNi1,
    ::testing::Values(
        Recorded{"Depth", "depth:16zT"}, Recorded{"DepthMirrored", "depth:16zT", "mirrored"},
        Recorded{"DepthTurned", "depth:16zT image:JPEG", "turned"},
        Recorded{"DepthWithoutTable", "depth:16zP"}, Recorded{"DepthNotEncoded", "depth:NONE"},
        Recorded{"DepthAndJpeg", "depth:16zT image:JPEG"},
        Recorded{"JpegAndDepthMirrored", "image:JPEG depth:16zT", "mirrored"},
        Recorded{"DepthAndRawImage", "depth:16zP image:NONE"},
        Recorded{"DepthAndGreyImage", "depth:16zT image:Im8z", "straight", false, false},
        Recorded{"GreyImageAndDepth", "image:Im8z depth:16zT", "straight", false, false},
        Recorded{"DepthAndInfrared", "depth:16zT ir:NONE"},
        Recorded{"InfraredImageAndDepth", "ir:NONE image:JPEG depth:16zT"},
        Recorded{"EncodedInfrared", "depth:16zT ir:16zP", "straight", false, false},
        Recorded{"Aborted", "depth:16zT", "straight", true, false},
        Recorded{"AbortedWithJpegMirrored", "image:JPEG depth:16zT", "mirrored", true, false}),
    name_of);

}  // namespace
}  // namespace lockbox
