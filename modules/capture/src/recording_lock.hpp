// SPDX-License-Identifier: BSD-3-Clause
// One recorder at a time into a file.
#pragma once

#include <sys/types.h>

#include <filesystem>

namespace lockbox {

/// Locks the file that a recording grows in, which takes the place of the recording at the end, and
/// stays locked then.
class RecordingLock {
 public:
  /// Creates the growing file. Throws InputError if another recorder has it, or the recording, or
  /// if it cannot be written.
  explicit RecordingLock(const std::filesystem::path& recording);

  /// Leaves no growing file behind.
  ~RecordingLock();
  RecordingLock(const RecordingLock&) = delete;
  RecordingLock& operator=(const RecordingLock&) = delete;

  /// A process that inherits it shares the lock.
  int descriptor() const { return descriptor_; }

 private:
  bool is_growing_file() const;

  std::filesystem::path growing_;
  int descriptor_ = -1;
};

}  // namespace lockbox
