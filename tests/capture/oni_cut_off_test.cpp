// SPDX-License-Identifier: BSD-3-Clause
// Recordings whose end is missing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>

#include "lockbox/capture/oni_validator.hpp"
#include "oni_bytes.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

TEST(OniCutOff, ARecordingWithoutTheFinalNumberOfFramesPlays) {
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

std::size_t frames_before(const OniRecording& recording, std::size_t cut) {
  return static_cast<std::size_t>(
      std::count_if(recording.payloads.begin(), recording.payloads.end(),
                    [cut](const OniPayload& frame) { return frame.offset + frame.size <= cut; }));
}

TEST(OniCutOff, WhatIsCompleteBeforeACutIsFoundWhereverTheCutIs) {
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
    EXPECT_THAT([&] { validate_oni(cut_file); },
                ::testing::ThrowsMessage<InputError>(::testing::HasSubstr("breaks off")))
        << cut;
  }
}

TEST(OniCutOff, ACutRecordingPlaysUpToTheCut) {
  const TemporaryFolder folder;
  const std::string sound = sound_recording(folder);
  const OniRecording recording = validate_oni(folder / "sound.oni");
  for (const std::size_t offset : record_offsets(sound)) {
    for (const std::size_t cut : {offset, offset + 45}) {
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
TEST(OniCutOff, ARecordingThatEndsInZerosPlaysUpToThem) {
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

TEST(OniCutOff, ACutRecordingKeepsItsUnitOfDepth) {
  const TemporaryFolder folder;
  constexpr float kTenthOfMillimetre = 0.0001F;
  const auto record = [&folder] {
    OniWriter writer(folder / "fine.oni", tiny_camera(), 30, kTenthOfMillimetre);
    for (std::uint64_t number = 0; number < 2; ++number) {
      DepthFrame frame = synthetic_frame(number, tiny_camera());
      frame.metres_per_unit = kTenthOfMillimetre;
      writer.write(frame);
    }
    writer.finish();
    return 0;
  };
  ASSERT_EQ(status_of_child(record), 0);
  std::filesystem::resize_file(folder / "fine.oni",
                               std::filesystem::file_size(folder / "fine.oni") - 20);
  const auto play = [&folder] {
    OniPlayer player(folder / "fine.oni");
    DepthFrame frame;
    return player.next(frame) && frame.metres_per_unit == kTenthOfMillimetre ? 0 : 1;
  };
  EXPECT_EQ(status_of_child(play), 0);
}

TEST(OniCutOff, WithoutRoomForTheCopyTheFolderIsNamedAndLeftEmpty) {
  const TemporaryFolder folder;
  const std::string sound = sound_recording(folder);
  write_file(folder / "cut.oni", sound.substr(0, sound.size() - 20));
  std::filesystem::create_directory(folder / "temporary");
  const auto play = [&] {
    ::setenv("TMPDIR", (folder / "temporary").c_str(), 1);
    const rlimit limit{1000, 1000};  // bytes, as on a full disk
    ::setrlimit(RLIMIT_FSIZE, &limit);
    std::signal(SIGXFSZ, SIG_IGN);
    try {
      OniPlayer(folder / "cut.oni");
    } catch (const InputError& error) {
      return std::string(error.what()).find("set TMPDIR to a folder with more room") !=
                     std::string::npos
                 ? 0
                 : 1;
    }
    return 2;
  };
  EXPECT_EQ(status_of_child(play), 0);
  EXPECT_TRUE(std::filesystem::is_empty(folder / "temporary"));
}

}  // namespace
}  // namespace lockbox
