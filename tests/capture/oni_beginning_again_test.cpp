// SPDX-License-Identifier: BSD-3-Clause
// OpenNI2's player begins a recording again as soon as its last frame was taken, and replaces all
// its properties then, on its own thread and without a lock.
#include <gtest/gtest.h>
#include <sched.h>

#include "oni_bytes.hpp"

namespace lockbox {
namespace {

/// With its field of view many times, so that the player replaces it for many milliseconds.
std::string with_long_beginning(const std::string& sound) {
  constexpr int kTimes = 4000;
  const std::vector<std::size_t> offsets = record_offsets(sound);
  std::string slow = sound.substr(0, offsets.front());
  for (std::size_t i = 0; i + 1 < offsets.size(); ++i) {
    std::string record = sound.substr(offsets[i], offsets[i + 1] - offsets[i]);
    const auto type = value_at<std::uint32_t>(record, 4);
    if (type == kNodeAdded) record.replace(record.size() - 8, 8, 8, '\0');  // no seek table
    if (type == kSeekTable) continue;
    const bool is_field_of_view =
        type == kGeneralProperty && record.find("xnFOV") != std::string::npos;
    for (int k = 0; k < (is_field_of_view ? kTimes : 1); ++k) slow += record;
  }
  return slow;
}

/// Then the player's thread goes on while the one that waits for its frame is not yet awake.
void use_one_processor() {
  cpu_set_t processors;
  CPU_ZERO(&processors);
  CPU_SET(::sched_getcpu(), &processors);
  ::sched_setaffinity(0, sizeof(processors), &processors);
}

TEST(OniBeginningAgain, DoesNotReachTheCameraOfTheLastFrame) {
  const TemporaryFolder folder;
  write_file(folder / "slow.oni", with_long_beginning(sound_recording(folder)));
  const auto cameras_are_right = [&folder] {
    use_one_processor();
    for (int reading = 0; reading < 15; ++reading) {
      OniPlayer player(folder / "slow.oni");
      DepthFrame frame;
      for (std::size_t number = 0; number < kFramesOfSound; ++number) {
        if (!player.next(frame) || !(frame.camera == tiny_camera())) return 1;
      }
    }
    return 0;
  };
  EXPECT_EQ(status_of_child(cameras_are_right), 0);
}

}  // namespace
}  // namespace lockbox
