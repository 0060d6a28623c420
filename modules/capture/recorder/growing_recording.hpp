// SPDX-License-Identifier: BSD-3-Clause
// An .oni file while OpenNI2 writes it.
#pragma once

#include <cstdint>
#include <filesystem>

#include "oni_records.hpp"

namespace lockbox {

/// Follows the records of a recording that is being written.
class GrowingRecording {
 public:
  explicit GrowingRecording(const std::filesystem::path& file) : file_(file) {}

  /// Looks at what was written since.
  void update();

  int frame_count() const { return frame_count_; }

  /// Has the end mark been written?
  bool is_complete() const;

  /// Waits until the last record is of this type. Throws DeviceError after ten seconds.
  void wait_for(OniRecordType type);

 private:
  std::filesystem::path file_;
  std::streamoff next_ = OniHeader::kSize;
  OniRecordType last_type_{};
  int frame_count_ = 0;
};

/// Number of frames of a recording that was written to its end; throws DeviceError if it was not.
int complete_frames(const std::filesystem::path& file);

/// Bytes by which the file can grow: OpenNI2 does not notice when its disk is full.
std::uintmax_t room_for(const std::filesystem::path& file);

}  // namespace lockbox
