// SPDX-License-Identifier: BSD-3-Clause
// Recordings with a wrong byte: OpenNI2 alone is killed by every fourth or so of these.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>

#include "lockbox/capture/oni_validator.hpp"
#include "oni_bytes.hpp"
#include "recorded_streams.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

/// LOCKBOX_MUTATIONS asks for more than the few that are always tried.
int number_of_mutations() {
  const char* const asked = std::getenv("LOCKBOX_MUTATIONS");
  return asked == nullptr ? 20 : std::atoi(asked);
}

/// Plays the recording with one byte changed after the other. Most are in the records before the
/// frames, where the player is most fragile.
void expect_mutations_to_be_harmless(const std::filesystem::path& file) {
  const std::string sound = read_file(file);
  const std::uint64_t header_end = validate_oni(file).payloads.front().offset;
  const std::filesystem::path mutant = file.parent_path() / "mutant.oni";
  std::mt19937 random(20240229);
  const int mutations = number_of_mutations();
  int refused = 0;
  for (int i = 0; i < mutations; ++i) {
    std::string bytes = sound;
    const std::size_t position = random() % (i % 3 == 0 ? bytes.size() : header_end);
    bytes[position] = static_cast<char>(random());
    write_file(mutant, bytes);
    const int result = status_of_child([&mutant] { return replay(mutant); });
    EXPECT_TRUE(result == kComplete || result == kRefused)
        << "case " << i << ": byte " << position << " gave " << result;
    refused += result == kRefused ? 1 : 0;
  }
  EXPECT_GT(refused, mutations / 10);
  EXPECT_LT(refused, mutations);
}

TEST(OniMutations, AnyByteOfADepthRecordingMayBeWrong) {
  const TemporaryFolder folder;
  sound_recording(folder);
  expect_mutations_to_be_harmless(folder / "sound.oni");
}

void expect_mutations_of_streams_to_be_harmless(const Streams& streams) {
  const TemporaryFolder folder;
  const auto record = [&] {
    constexpr int kFrames = 4;
    record_streams(folder / "streams.oni", streams, kFrames, tiny_camera());
    return 0;
  };
  ASSERT_EQ(status_of_child(record), 0);
  std::filesystem::resize_file(folder / "streams.oni",
                               validate_oni(folder / "streams.oni").end);  // zeros follow
  expect_mutations_to_be_harmless(folder / "streams.oni");
}

TEST(OniMutations, AnyByteOfARecordingOfThreeStreamsMayBeWrong) {
  expect_mutations_of_streams_to_be_harmless(
      {{openni::SENSOR_COLOR, openni::SENSOR_DEPTH, openni::SENSOR_IR}, true, true});
}

TEST(OniMutations, AnyByteOfACroppedRecordingMayBeWrong) {
  expect_mutations_of_streams_to_be_harmless(
      {{openni::SENSOR_DEPTH}, false, false, Region{5, 3, 20, 17}});
}

}  // namespace
}  // namespace lockbox
