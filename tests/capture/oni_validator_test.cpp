// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/capture/oni_validator.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <random>

#include "lockbox/capture/oni_player.hpp"
#include "lockbox/capture/oni_writer.hpp"
#include "lockbox/core/error.hpp"
#include "synthetic_frames.hpp"

namespace lockbox {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr std::size_t kFrames = 4;

void write_file(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

std::string read_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Runs work in a child process, because what it does may crash, and returns its exit status; -1
/// if it crashed or hung.
int status_of_child(const std::function<int()>& work) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::alarm(20);
    ::_exit(work());
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// The bytes of a small sound recording.
std::string sound_recording(const TemporaryFolder& folder) {
  const std::filesystem::path file = folder / "sound.oni";
  const auto record = [&file] {
    OniWriter writer(file, {32, 24, 30.0, 30.0, 15.5, 11.5}, 30);
    for (std::uint64_t number = 0; number < kFrames; ++number) {
      writer.write(synthetic_frame(number, {32, 24, 30.0, 30.0, 15.5, 11.5}));
    }
    writer.finish();
    return 0;
  };
  EXPECT_EQ(status_of_child(record), 0);
  return read_file(file);
}

enum Replay { kComplete = 0, kRefused = 10, kIncomplete = 11 };

Replay replay(const std::filesystem::path& file) {
  DepthFrame frame;
  std::size_t count = 0;
  try {
    OniPlayer player(file);
    while (player.next(frame)) {
      ++count;
    }
    return count == player.frame_count() ? kComplete : kIncomplete;
  } catch (const InputError&) {
    return kRefused;
  }
}

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
      {"only_header.oni", sound.substr(0, 24), "truncated or unfinished"},
      {"truncated.oni", sound.substr(0, sound.size() / 2), "is truncated: it ends at byte"},
      {"no_end.oni", sound.substr(0, sound.size() - 28), "truncated or unfinished"},
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
  EXPECT_EQ(recording.width, 32);
  EXPECT_EQ(recording.height, 24);
  EXPECT_EQ(recording.frame_count, kFrames);
  EXPECT_FALSE(recording.mirrored);
  EXPECT_EQ(recording.end, bytes.size());
  EXPECT_EQ(recording.payloads.size(), kFrames);
  EXPECT_NO_THROW(OniPayloadChecker(recording).check_through(kFrames));
}

TEST(OniValidator, AnUnfinishedRecordingSaysSo) {
  const TemporaryFolder folder;
  std::string bytes = sound_recording(folder);
  const std::size_t count = bytes.find("16zT") + 4;
  bytes.replace(count, 4, "\xff\xff\xff\xff");
  write_file(folder / "unfinished.oni", bytes);
  EXPECT_THAT([&] { validate_oni(folder / "unfinished.oni"); },
              ThrowsMessage<InputError>(HasSubstr("is unfinished")));
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

// OpenNI2 alone is killed by every fourth or so of these.
TEST(OniValidator, AnyFlippedByteIsRefusedOrPlayedCompletely) {
  constexpr int kCases = 60;
  const TemporaryFolder folder;
  const std::string sound = sound_recording(folder);
  const std::uint64_t header_end = validate_oni(folder / "sound.oni").payloads.front().offset;
  std::mt19937 random(20240229);
  int refused = 0;
  for (int i = 0; i < kCases; ++i) {
    std::string bytes = sound;
    // Most cases hit the records before the frames, where the player is most fragile.
    const std::uint64_t range = i % 3 == 0 ? bytes.size() : header_end;
    const std::size_t position = random() % range;
    bytes[position] = static_cast<char>(random());
    write_file(folder / "flipped.oni", bytes);
    const int result = status_of_child([&folder] { return replay(folder / "flipped.oni"); });
    EXPECT_TRUE(result == kComplete || result == kRefused)
        << "case " << i << ": byte " << position << " gave " << result;
    refused += result == kRefused ? 1 : 0;
  }
  EXPECT_GT(refused, kCases / 4);
  EXPECT_LT(refused, kCases);
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
