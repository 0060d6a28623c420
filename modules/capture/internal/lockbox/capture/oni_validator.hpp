// SPDX-License-Identifier: BSD-3-Clause
// Checks a .oni recording before OpenNI2 sees it: OpenNI2's player crashes, hangs or silently skips
// frames on damaged files. Frames themselves always come from OpenNI2 (oni_player.hpp).
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace lockbox {

/// One encoded frame of any stream.
struct OniPayload {
  std::uint64_t offset = 0;     ///< bytes from the beginning of the file
  std::uint32_t size = 0;       ///< bytes
  std::uint32_t frame = 0;      ///< number within its stream, from 1
  std::uint64_t timestamp = 0;  ///< microseconds
  std::array<char, 4> codec{};
  bool depth = false;      ///< of the depth stream
  std::size_t pixels = 0;  ///< of the decoded image
};

/// How what was recorded of a depth image lies in the image that the camera describes. All in
/// pixels.
struct OniImage {
  int width = 0;  ///< of the camera's image
  int height = 0;
  bool mirrored = false;  ///< columns run from right to left
  int left = 0;           ///< of what was recorded, in the image as it was recorded
  int top = 0;
  int recorded_width = 0;  ///< less than width if it was cropped
  int recorded_height = 0;

  bool operator==(const OniImage&) const = default;
  std::size_t recorded_pixels() const {
    return static_cast<std::size_t>(recorded_width) * static_cast<std::size_t>(recorded_height);
  }
};

/// A property of the depth stream that changes on the way.
struct OniChange {
  std::size_t frame = 0;  ///< index of the first depth image that it concerns, from 0
  std::string name;
  std::vector<std::uint8_t> value;
};

/// What a recording holds that can be played.
struct OniRecording {
  std::filesystem::path file;
  std::size_t frame_count = 0;       ///< of the depth stream
  std::vector<OniImage> images;      ///< each depth image
  std::uint64_t end = 0;             ///< bytes up to the end of the last record
  std::vector<OniPayload> payloads;  ///< in file order; if it is not plain, of depth only

  /// OpenNI2 plays the file as it is. Else it gets a copy of the depth (copy_depth()): the end is
  /// missing, the version is an old one, or there is something about its streams that OpenNI2 does
  /// not take.
  bool is_plain = true;
  /// The end mark is missing, as whatever recorded was stopped, or the file was not copied to its
  /// end; what is complete can be played.
  bool is_cut_off = false;
  /// Why the depth images behind the last one cannot be played, if there are such and it is not
  /// the end that is missing.
  std::string end_reason;
  /// Properties of the depth stream that say what its images mean, by name, and their changes.
  std::map<std::string, std::vector<std::uint8_t>> depth_properties;
  std::vector<OniChange> depth_changes;
};

/// Checks everything but the frames' contents, without reading these: milliseconds even for long
/// recordings. Throws InputError that says what is wrong, where, and what to do.
OniRecording validate_oni(const std::filesystem::path& file);

/// What remains is not plain.
void leave_out_other_streams(OniRecording& recording);

/// Leaves out all that follows the first frame_count depth images; reason tells what begins there.
/// Throws InputError if nothing remains.
void end_early(OniRecording& recording, std::size_t frame_count, const std::string& reason);

/// Writes the depth of a recording as a file that OpenNI2 plays: complete, finished, of the newest
/// version, with nothing but what was checked. Throws InputError if there is no room for it.
void copy_depth(const OniRecording& recording, const std::filesystem::path& copy);

/// Checks the contents of frames: each decodes to exactly one image.
class OniPayloadChecker {
 public:
  explicit OniPayloadChecker(const OniRecording& recording);

  /// Checks all payloads up to and including depth frame number `frame` (from 1), or the whole file
  /// if there are fewer, unless done before. Throws InputError at the first damaged depth image;
  /// returns false, and goes no further, at a damaged image of another stream. Depth images that
  /// are sound, but of a size that the file does not tell, end the recording, for end_reason().
  bool check_through(std::size_t frame);

  /// Why no depth image behind frame_count() is sound; empty as long as there is no reason.
  const std::string& end_reason() const { return end_reason_; }
  std::size_t frame_count() const { return frame_count_; }

 private:
  /// Not a single one, which may be damaged.
  bool begins_another_size(const OniPayload& payload);

  OniRecording recording_;
  std::ifstream stream_;
  std::vector<std::uint8_t> buffer_;
  std::size_t next_ = 0;
  std::string end_reason_;
  std::size_t frame_count_ = 0;
};

}  // namespace lockbox
