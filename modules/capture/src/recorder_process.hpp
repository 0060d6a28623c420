// SPDX-License-Identifier: BSD-3-Clause
// The helper process in which OpenNI2 records.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>

#include "recording_lock.hpp"

namespace lockbox {

class RecorderProcess {
 public:
  /// The number under which the process inherits `socket`.
  static constexpr int kSocket = 3;

  /// Records the device with this URI, in this mode (empty: the usual one), into a file, whose lock
  /// it shares. Throws InputError if the helper is missing, DeviceError if it does not start.
  RecorderProcess(const std::string& uri, const std::string& mode,
                  const std::filesystem::path& file, const RecordingLock& lock,
                  std::optional<int> socket = std::nullopt);

  /// Stops and waits.
  ~RecorderProcess();
  RecorderProcess(const RecorderProcess&) = delete;
  RecorderProcess& operator=(const RecorderProcess&) = delete;

  /// False when it has ended by itself: its device was unplugged, or it failed.
  bool is_running();

  /// Asks it to stop, and waits until the file is complete. Throws DeviceError if it failed.
  void finish();

 private:
  void wait();

  std::string recording_;  ///< its file, for messages
  pid_t process_ = -1;
  int control_ = -1;  ///< closing it asks the process to stop
  int errors_ = -1;   ///< what it says when it fails
  int status_ = 0;
};

}  // namespace lockbox
