// SPDX-License-Identifier: BSD-3-Clause
// Recordings of versions that nothing writes any more.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>

#include "lockbox/capture/oni_validator.hpp"
#include "oni_bytes.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

template <typename T>
void append(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

/// Record by record as a version with 32-bit offsets, and without seek tables; nodes are added with
/// the type `node_added`, which has that many bytes behind the name.
std::string in_old_version(const std::string& sound, char build, std::uint32_t node_added,
                           std::size_t node_bytes) {
  std::string old("NI10\x01\x00\x00\x00", 8);
  old += build;
  old += std::string(3, '\0') + sound.substr(12, 12);
  for (const std::size_t offset : record_offsets(sound)) {
    if (offset == sound.size() || value_at<std::uint32_t>(sound, offset + 4) == kSeekTable) {
      continue;
    }
    const bool adds_node = value_at<std::uint32_t>(sound, offset + 4) == kNodeAdded;
    const auto fields = value_at<std::uint32_t>(sound, offset + 12);
    const auto payload = value_at<std::uint32_t>(sound, offset + 16);
    std::string contents = sound.substr(offset + 28, fields - 28);
    if (adds_node) {
      contents.resize(4 + value_at<std::uint32_t>(contents, 0) + node_bytes);
      if (node_added == kNodeAdded) {
        contents.replace(contents.size() - 4, 4, 4, '\0');  // no seek table
      }
    }
    old += sound.substr(offset, 4);
    append(old, adds_node ? node_added : value_at<std::uint32_t>(sound, offset + 4));
    old += sound.substr(offset + 8, 4);
    append(old, static_cast<std::uint32_t>(24 + contents.size()));
    append(old, payload);
    append(old, std::uint32_t{0});
    old += contents + sound.substr(offset + fields, payload);
  }
  return old;
}

void expect_complete(const std::filesystem::path& file) {
  const OniRecording recording = validate_oni(file);
  EXPECT_FALSE(recording.is_plain);
  EXPECT_FALSE(recording.is_cut_off);
  const auto play = [&file] {
    OniPlayer player(file);
    DepthFrame frame;
    for (std::size_t number = 0; number < kFramesOfSound; ++number) {
      if (!player.next(frame) || frame.depth != synthetic_frame(number, tiny_camera()).depth) {
        return 1;
      }
    }
    return player.next(frame) ? 2 : 0;
  };
  EXPECT_EQ(status_of_child(play), 0);
}

TEST(OniVersions, OldRecordingsPlay) {
  const TemporaryFolder folder;
  const std::string sound = sound_recording(folder);
  write_file(folder / "1.0.0.4.oni", in_old_version(sound, 4, 0x2, 8));
  expect_complete(folder / "1.0.0.4.oni");
  write_file(folder / "1.0.0.5.oni", in_old_version(sound, 5, 0xC, 28));
  expect_complete(folder / "1.0.0.5.oni");
  write_file(folder / "1.0.0.6.oni", in_old_version(sound, 6, kNodeAdded, 32));
  expect_complete(folder / "1.0.0.6.oni");
}

TEST(OniVersions, UnknownOnesAreRefused) {
  const TemporaryFolder folder;
  const std::string sound = sound_recording(folder);
  for (const char build : {'\x03', '\x00'}) {
    write_file(folder / "old.oni", in_old_version(sound, build, 0x2, 8));
    EXPECT_THAT(
        [&] { validate_oni(folder / "old.oni"); },
        ::testing::ThrowsMessage<InputError>(::testing::HasSubstr("format version 1.0.0.")));
  }
}

}  // namespace
}  // namespace lockbox
