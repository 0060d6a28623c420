// SPDX-License-Identifier: BSD-3-Clause
// A recording whose images have another size from the middle on, as OpenNI 1 can make them.
#include <gmock/gmock.h>

#include <cstdint>
#include <cstring>

#include "camera_file.hpp"
#include "lockbox/capture/oni_validator.hpp"
#include "tool.hpp"

namespace lockbox {
namespace {

using testing::HasSubstr;

constexpr std::size_t kFrames = 22;
constexpr std::size_t kLarge = 11;

/// One record of a .oni file, with its payload.
struct Record {
  std::uint32_t type;
  std::string bytes;
};

std::vector<Record> records_of(const std::string& file) {
  std::vector<Record> records;
  for (std::size_t at = 24; at < file.size();) {
    std::uint32_t type = 0;
    std::uint32_t fields = 0;
    std::uint32_t payload = 0;
    std::memcpy(&type, &file[at + 4], 4);
    std::memcpy(&fields, &file[at + 12], 4);
    std::memcpy(&payload, &file[at + 16], 4);
    records.push_back({type, file.substr(at, std::size_t{fields} + payload)});
    at += std::size_t{fields} + payload;
  }
  return records;
}

/// The first frames of one recording, then a change of mode, then the others of the other one.
std::string spliced(const std::string& first, const std::string& then) {
  constexpr std::uint32_t kProperty = 6;
  constexpr std::uint32_t kFrame = 0xA;
  std::string bytes = first.substr(0, 24);
  std::size_t frames = 0;
  for (const Record& record : records_of(first)) {
    frames += record.type == kFrame ? 1 : 0;
    if (frames > kLarge) break;
    bytes += record.bytes;
  }
  frames = 0;
  for (const Record& record : records_of(then)) {
    frames += record.type == kFrame ? 1 : 0;
    const bool is_mode =
        record.type == kProperty && record.bytes.find(std::string("xnMapOutputMode\0", 16)) < 60;
    if (is_mode || (record.type == kFrame && frames > kLarge)) bytes += record.bytes;
  }
  return bytes;
}

class ChangingSize : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  void simulate(const std::string& name, int width) const {
    write_camera_file(path(name + ".yaml"), width);
    const auto simulated = run_tool({"simulate", "--model", "rigid_block", "--trajectory", "auto",
                                     "--frames", std::to_string(kFrames), "--camera-info",
                                     path(name + ".yaml"), "--output", path(name + "/a.oni")});
    ASSERT_EQ(simulated.status, 0) << simulated.errors;
  }

  void SetUp() override {
    simulate("large", 320);
    simulate("small", 160);
    write_text(path("changing.oni"),
               spliced(read_text(path("large/a.oni")), read_text(path("small/a.oni"))));
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(ChangingSize, IsFollowedAndPaintedToTheEnd) {
  const auto tracked = run_tool(
      {"track", "--model", "rigid_block", "--source", path("changing.oni"), "--initial-state",
       path("large/groundtruth.csv"), "--output", path("run"), "--snapshots", path("snapshots")});
  EXPECT_EQ(tracked.status, 0) << tracked.errors;
  EXPECT_THAT(tracked.output, HasSubstr("22 frames, 22 tracking"));
  EXPECT_TRUE(std::filesystem::exists(path("snapshots/frame_000020.png")));
}

TEST_F(ChangingSize, IsRecordedAgainAsFarAsOneRecordingCan) {
  const auto recorded =
      run_tool({"record", "--source", path("changing.oni"), "--output", path("again.oni")});
  EXPECT_EQ(recorded.status, 3);
  EXPECT_THAT(recorded.errors,
              HasSubstr("changing.oni: frame 11 has another camera (160x120) than the recording " +
                        path("again.oni") + " (320x240), which ends before it"));
  EXPECT_EQ(validate_oni(path("again.oni")).frame_count, kLarge);
}

}  // namespace
}  // namespace lockbox
