// SPDX-License-Identifier: BSD-3-Clause
#include "recording_lock.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "growing_name.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/core/file_lock.hpp"

namespace lockbox {
namespace {

[[noreturn]] void refuse_second(const std::filesystem::path& recording) {
  throw InputError(recording.string(),
                   "another run is recording into this file; wait for its end, or choose another "
                   "name");
}

/// A number that no descriptor of the recorder's process takes the place of.
int above_the_standard_ones(int descriptor) {
  constexpr int kLeast = 10;
  const int moved = ::fcntl(descriptor, F_DUPFD_CLOEXEC, kLeast);
  ::close(descriptor);
  return moved;
}

/// Is another recorder still at the end of its work on what has the recording's name?
bool is_being_completed(const std::filesystem::path& recording) {
  const int descriptor = ::open(recording.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  const bool is_taken = descriptor >= 0 && !lock_alone(descriptor);
  if (descriptor >= 0) {
    ::close(descriptor);
  }
  return is_taken;
}

}  // namespace

RecordingLock::RecordingLock(const std::filesystem::path& recording)
    : growing_(growing_name(recording)) {
  descriptor_ =
      above_the_standard_ones(::open(growing_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC,
                                     S_IRUSR | S_IWUSR | S_IRGRP | S_IWGRP | S_IROTH | S_IWOTH));
  if (descriptor_ < 0) {
    throw InputError(recording.string(),
                     "cannot be written; does its folder exist, is it writable?");
  }
  // What was opened may have become the recording before it was locked.
  const bool is_locked = lock_alone(descriptor_) && is_growing_file();
  if (!is_locked || is_being_completed(recording)) {
    if (is_locked) {
      std::filesystem::remove(growing_);
    }
    ::close(descriptor_);
    refuse_second(recording);
  }
}

RecordingLock::~RecordingLock() {
  if (is_growing_file()) {
    std::error_code is_gone;
    std::filesystem::remove(growing_, is_gone);
  }
  ::close(descriptor_);
}

bool RecordingLock::is_growing_file() const {
  struct stat own {};
  struct stat named {};
  return ::fstat(descriptor_, &own) == 0 && ::stat(growing_.c_str(), &named) == 0 &&
         own.st_ino == named.st_ino && own.st_dev == named.st_dev;
}

}  // namespace lockbox
