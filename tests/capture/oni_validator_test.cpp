// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/capture/oni_validator.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "oni_bytes.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

struct Refusal {
  const char* name;
  std::string bytes;
  const char* message;
};

TEST(OniValidator, FilesThatAreNoRecordingsAreNamedForWhatTheyAre) {
  const TemporaryFolder folder;
  const std::string sound = sound_recording(folder);
  const std::vector<Refusal> refusals{
      {"empty.oni", "", "is empty"},
      {"text.oni", "hello, this is text and no recording at all", "is not an OpenNI recording"},
      {"short.oni", "NI", "is not an OpenNI recording"},
      {"header.oni", sound.substr(0, 20), "ends within the header, at byte 20"},
      {"only_header.oni", sound.substr(0, 24), "breaks off at byte 24, before its first"},
      {"no_frame.oni", sound.substr(0, 1000), "before its first complete depth image"},
      {"version.oni", "NI10\x02" + sound.substr(5), "format version 2.0"},
  };
  for (const Refusal& refusal : refusals) {
    write_file(folder / refusal.name, refusal.bytes);
    EXPECT_THAT([&] { validate_oni(folder / refusal.name); },
                ThrowsMessage<InputError>(HasSubstr(refusal.message)))
        << refusal.name;
  }
}

TEST(OniValidator, WhatIsNoFileIsNamed) {
  const TemporaryFolder folder;
  EXPECT_THAT([&] { validate_oni(folder / "missing.oni"); },
              ThrowsMessage<InputError>(HasSubstr("missing.oni: no such file")));
  EXPECT_THAT([&] { validate_oni(folder.path()); },
              ThrowsMessage<InputError>(HasSubstr("is a folder")));
  EXPECT_THAT([] { validate_oni("/dev/null"); },
              ThrowsMessage<InputError>(HasSubstr("not a regular file")));
}

TEST(OniValidator, ASoundRecordingIsDescribed) {
  const TemporaryFolder folder;
  const std::string bytes = sound_recording(folder);
  const OniRecording recording = validate_oni(folder / "sound.oni");
  EXPECT_EQ(recording.frame_count, kFramesOfSound);
  const OniImage whole{.width = 32, .height = 24, .recorded_width = 32, .recorded_height = 24};
  EXPECT_EQ(recording.images, std::vector<OniImage>(kFramesOfSound, whole));
  EXPECT_EQ(recording.end, bytes.size());
  EXPECT_EQ(recording.payloads.size(), kFramesOfSound);
  EXPECT_NO_THROW(OniPayloadChecker(recording).check_through(kFramesOfSound));
}

TEST(OniValidator, ADamagedFrameIsFoundBeforeItIsDecoded) {
  const TemporaryFolder folder;
  std::string bytes = sound_recording(folder);
  const OniPayload third = validate_oni(folder / "sound.oni").payloads[2];
  bytes.replace(third.offset + third.size - 2, 2, "\xff\x7f");
  write_file(folder / "damaged.oni", bytes);
  OniPayloadChecker checker(validate_oni(folder / "damaged.oni"));
  EXPECT_NO_THROW(checker.check_through(2));
  EXPECT_THAT([&] { checker.check_through(3); },
              ThrowsMessage<InputError>(
                  HasSubstr("frame 3 is damaged, at byte " + std::to_string(third.offset))));
}

/// Real recordings are not part of the repository; LOCKBOX_TEST_DATA names the folder of them.
class RealRecordings : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* const folder = std::getenv("LOCKBOX_TEST_DATA");
    if (folder == nullptr) {
      GTEST_SKIP() << "LOCKBOX_TEST_DATA is not set";
    }
    recordings_ = std::filesystem::path(folder) / "recordings";
  }
  std::filesystem::path recordings_;
};

TEST_F(RealRecordings, AMirroredOpenNi1RecordingWithColourPlaysCompletely) {
  OniPlayer player(recordings_ / "3dj_test.oni");
  EXPECT_THAT(player.description(), HasSubstr("mirrored"));
  DepthFrame frame;
  std::size_t count = 0;
  while (player.next(frame)) {
    ++count;
  }
  EXPECT_EQ(count, 12U);
  EXPECT_EQ(frame.camera.width, 640);
  EXPECT_NEAR(frame.camera.fx, 575.8157, 1e-4);
  EXPECT_NEAR(frame.camera.fy, 575.8157, 1e-4);
  EXPECT_EQ(frame.camera.cx, 319.5);
  EXPECT_NEAR(frame.stamp, 0.3787, 1e-3);
}

TEST_F(RealRecordings, AnAbortedRecordingIsRefused) {
  EXPECT_THAT([this] { OniPlayer(recordings_ / "aborted.oni"); },
              ThrowsMessage<InputError>(HasSubstr("holds no depth stream")));
}

}  // namespace
}  // namespace lockbox
