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
  EXPECT_EQ(recording.mirrored, mirrored_frames(GetParam().mirroring));
  EXPECT_EQ(recording.is_cut_off, GetParam().aborted);
  EXPECT_EQ(recording.is_plain, GetParam().plain);
  OniPlayer player(file);
  ASSERT_EQ(player.frame_count(), kFrames);
  DepthFrame frame;
  for (std::uint64_t number = 0; number < kFrames; ++number) {
    ASSERT_TRUE(player.next(frame));
    DepthFrame expected = synthetic_frame(number, frame.camera);
    if (recording.mirrored[number]) {  // the recorder takes what the node says it has made
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
