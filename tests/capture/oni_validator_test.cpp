// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/capture/oni_validator.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
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

PinholeCamera tiny_camera() {
  return {32, 24, 30.0, 30.0, 15.5, 11.5};
}

/// The bytes of a small sound recording.
std::string sound_recording(const TemporaryFolder& folder) {
  const std::filesystem::path file = folder / "sound.oni";
  const auto record = [&file] {
    OniWriter writer(file, tiny_camera(), 30);
    for (std::uint64_t number = 0; number < kFrames; ++number) {
      writer.write(synthetic_frame(number, tiny_camera()));
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
  EXPECT_EQ(recording.width, 32);
  EXPECT_EQ(recording.height, 24);
  EXPECT_EQ(recording.frame_count, kFrames);
  EXPECT_FALSE(recording.mirrored);
  EXPECT_EQ(recording.end, bytes.size());
  EXPECT_EQ(recording.payloads.size(), kFrames);
  EXPECT_NO_THROW(OniPayloadChecker(recording).check_through(kFrames));
}

TEST(OniValidator, ARecordingWithoutTheFinalNumberOfFramesPlays) {
  const TemporaryFolder folder;
  std::string bytes = sound_recording(folder);
  const std::size_t count = bytes.find("16zT") + 4;
  bytes.replace(count, 4, "\xff\xff\xff\xff");
  write_file(folder / "unfinished.oni", bytes);
  EXPECT_FALSE(validate_oni(folder / "unfinished.oni").is_plain);
  EXPECT_EQ(status_of_child([&] { return replay(folder / "unfinished.oni"); }), kComplete);
}

/// Plays the first `size` bytes of a recording: 0 if all complete frames came, bit for bit, in
/// order, and the cut was said once.
int replay_cut(const std::filesystem::path& file, const std::string& bytes, std::size_t frames) {
  write_file(file, bytes);
  int warnings = 0;
  SourceOptions options;
  options.warn = [&](const std::string& text) {
    warnings += text.find("breaks off at byte ") != std::string::npos ? 1 : 100;
  };
  OniPlayer player(file, options);
  DepthFrame frame;
  for (std::size_t number = 0; number < frames; ++number) {
    if (!player.next(frame) || frame.depth != synthetic_frame(number, tiny_camera()).depth) {
      return 1;
    }
  }
  return player.next(frame) ? 2 : warnings == 1 ? 0 : 3;
}

/// Offsets of all records of a sound recording, and of its end.
std::vector<std::size_t> record_offsets(const std::string& bytes) {
  std::vector<std::size_t> offsets;
  for (std::size_t offset = 24; offset < bytes.size();) {
    offsets.push_back(offset);
    std::uint32_t fields = 0;
    std::uint32_t payload = 0;
    std::memcpy(&fields, &bytes[offset + 12], 4);
    std::memcpy(&payload, &bytes[offset + 16], 4);
    offset += std::size_t{fields} + payload;
  }
  offsets.push_back(bytes.size());
  return offsets;
}

std::size_t frames_before(const OniRecording& recording, std::size_t cut) {
  return static_cast<std::size_t>(
      std::count_if(recording.payloads.begin(), recording.payloads.end(),
                    [cut](const OniPayload& frame) { return frame.offset + frame.size <= cut; }));
}

TEST(OniValidator, WhatIsCompleteBeforeACutIsFoundWhereverTheCutIs) {
  const TemporaryFolder folder;
  const std::string sound = sound_recording(folder);
  const OniRecording recording = validate_oni(folder / "sound.oni");
  const std::filesystem::path cut_file = folder / "cut.oni";
  write_file(cut_file, sound);
  std::size_t cut = sound.size() - 1;
  for (; frames_before(recording, cut) > 0; cut -= cut % 7 + 1) {
    std::filesystem::resize_file(cut_file, cut);
    const OniRecording found = validate_oni(cut_file);
    EXPECT_TRUE(found.is_cut_off) << cut;
    EXPECT_EQ(found.frame_count, frames_before(recording, cut)) << cut;
  }
  for (; cut >= 24; cut -= cut % 7 + 1) {
    std::filesystem::resize_file(cut_file, cut);
    EXPECT_THAT([&] { validate_oni(cut_file); }, ThrowsMessage<InputError>(HasSubstr("breaks off")))
        << cut;
  }
}

TEST(OniValidator, ACutRecordingPlaysUpToTheCut) {
  const TemporaryFolder folder;
  const std::string sound = sound_recording(folder);
  const OniRecording recording = validate_oni(folder / "sound.oni");
  for (const std::size_t offset : record_offsets(sound)) {
    for (const std::size_t cut : {offset, offset + 27, offset + 45}) {
      const std::size_t frames = frames_before(recording, cut);
      if (frames == 0 || cut >= sound.size()) {
        continue;
      }
      EXPECT_EQ(status_of_child(
                    [&] { return replay_cut(folder / "cut.oni", sound.substr(0, cut), frames); }),
                0)
          << cut;
    }
  }
}

// After a loss of power, parts of a file that were not written yet are zero.
TEST(OniValidator, ARecordingThatEndsInZerosPlaysUpToThem) {
  const TemporaryFolder folder;
  const std::string sound = sound_recording(folder);
  const OniRecording recording = validate_oni(folder / "sound.oni");
  const OniPayload third = recording.payloads[2];
  for (const std::uint64_t end : {third.offset - 40, third.offset, third.offset + third.size / 2,
                                  third.offset + third.size - 1}) {
    std::string bytes = sound.substr(0, end);
    bytes.resize(sound.size());
    const int result = status_of_child([&] { return replay_cut(folder / "zeros.oni", bytes, 2); });
    EXPECT_EQ(result, 0) << end;
  }
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
