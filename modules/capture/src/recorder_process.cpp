// SPDX-License-Identifier: BSD-3-Clause
#include "recorder_process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <utility>

#include "lockbox/core/component.hpp"
#include "lockbox/core/error.hpp"

namespace lockbox {
namespace {

constexpr char kInThisLibrary = 0;  // its address is in this library

struct Pipe {
  explicit Pipe(const std::string& recording) {
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
      throw DeviceError(recording + ": its recorder cannot be started: " + std::strerror(errno));
    }
  }
  std::array<int, 2> ends{};
};

}  // namespace

RecorderProcess::RecorderProcess(const std::string& uri, const std::string& mode,
                                 const std::filesystem::path& file, const RecordingLock& lock,
                                 std::optional<int> socket)
    : recording_(file.string()) {
  std::string program = find_component("lockbox-oni-recorder", &kInThisLibrary).string();
  std::string uri_argument = uri;
  std::string mode_argument = mode;
  std::string file_argument = std::filesystem::absolute(file).string();
  const Pipe control(recording_);
  const Pipe errors(recording_);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, control.ends[0], STDIN_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, errors.ends[1], STDERR_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, lock.descriptor(), lock.descriptor());  // inherited
  if (socket) {  // last: kSocket may be the number of a pipe
    ::posix_spawn_file_actions_adddup2(&actions, *socket, kSocket);
  }
  std::array<char*, 5> arguments{program.data(), uri_argument.data(), file_argument.data(),
                                 mode_argument.empty() ? nullptr : mode_argument.data(), nullptr};
  const int failure =
      ::posix_spawn(&process_, program.c_str(), &actions, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  ::close(control.ends[0]);
  ::close(errors.ends[1]);
  control_ = control.ends[1];
  errors_ = errors.ends[0];
  if (failure != 0) {
    ::close(control_);
    ::close(errors_);
    throw DeviceError(recording_ + ": its recorder, " + program +
                      ", cannot be started: " + std::strerror(failure));
  }
}

RecorderProcess::~RecorderProcess() {
  wait();
  ::close(errors_);
}

bool RecorderProcess::is_running() {
  if (process_ > 0 && ::waitpid(process_, &status_, WNOHANG) == process_) {
    process_ = -1;
  }
  return process_ > 0;
}

void RecorderProcess::wait() {
  if (control_ >= 0) {
    ::close(std::exchange(control_, -1));
  }
  if (process_ > 0) {
    ::waitpid(std::exchange(process_, -1), &status_, 0);
  }
}

void RecorderProcess::finish() {
  wait();
  if (WIFEXITED(status_) && WEXITSTATUS(status_) == 0) {
    return;
  }
  std::array<char, 2000> text{};
  const ssize_t size = ::read(errors_, text.data(), text.size());
  std::string reason(text.data(), static_cast<std::size_t>(size > 0 ? size : 0));
  reason.erase(reason.find_last_not_of(" \n") + 1);
  throw DeviceError(reason.empty() ? recording_ + ": the recorder of OpenNI2 crashed" : reason);
}

}  // namespace lockbox
