// SPDX-License-Identifier: BSD-3-Clause
#include "video_file.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "lockbox/core/error.hpp"

namespace lockbox::app {
namespace {

constexpr int kRate = 30;             // pictures a second
constexpr int kLongestPause = kRate;  // pictures for one frame, however long the next one takes

/// Returns the arguments of ffmpeg: raw pictures in, any size out (of even numbers, as most
/// decoders want).
std::vector<std::string> encoder_arguments(const std::filesystem::path& file, int width,
                                           int height) {
  return {"ffmpeg",
          "-loglevel",
          "error",
          "-y",
          "-f",
          "rawvideo",
          "-pix_fmt",
          "rgb24",
          "-s",
          std::to_string(width) + "x" + std::to_string(height),
          "-framerate",
          std::to_string(kRate),
          "-i",
          "pipe:0",
          "-vf",
          "pad=ceil(iw/2)*2:ceil(ih/2)*2",
          "-pix_fmt",
          "yuv420p",
          "file:" + file.string()};
}

/// Starts it with the socket as its standard input, and in a process group of its own: Ctrl-C is
/// not for it. Returns 0, or why it does not start.
int start_encoder(std::vector<std::string> words, int input, pid_t& process) {
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (auto& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
  ::posix_spawnattr_init(&attributes);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  const int problem =
      ::posix_spawnp(&process, "ffmpeg", &actions, &attributes, arguments.data(), environ);
  ::posix_spawnattr_destroy(&attributes);
  ::posix_spawn_file_actions_destroy(&actions);
  return problem;
}

}  // namespace

VideoFile::VideoFile(const std::filesystem::path& file, int width, int height) : file_(file) {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    throw InputError(file.string(), "no socket to ffmpeg can be made");
  }
  const int problem = start_encoder(encoder_arguments(file, width, height), ends[1], encoder_);
  ::close(ends[1]);
  socket_ = ends[0];
  if (problem == 0) return;
  ::close(socket_);
  throw InputError(file.string(), std::string("ffmpeg, which encodes videos, does not start (") +
                                      std::strerror(problem) +
                                      "); install it (apt-get install ffmpeg), or take --pictures "
                                      "DIR, of which other programs make videos");
}

VideoFile::~VideoFile() {
  end();
}

/// A picture stays until the next one's time has come.
void VideoFile::add(const RgbImage& picture, double stamp) {
  if (!start_) start_ = stamp;
  const auto due = std::max<std::int64_t>(std::llround((stamp - *start_) * kRate) + 1, written_);
  const std::int64_t pictures = std::min<std::int64_t>(due - written_, kLongestPause);
  if (due - written_ > pictures) *start_ += static_cast<double>(due - written_ - pictures) / kRate;
  for (std::int64_t i = 0; i < pictures; ++i) write(picture);
}

void VideoFile::write(const RgbImage& picture) {
  const auto* from = reinterpret_cast<const char*>(picture.rgb.data());
  for (std::size_t left = picture.rgb.size(); left > 0;) {
    const ssize_t sent = ::send(socket_, from, left, MSG_NOSIGNAL);
    if (sent <= 0) throw InputError(file_.string(), "ffmpeg does not write it; it says why above");
    from += sent;
    left -= static_cast<std::size_t>(sent);
  }
  ++written_;
}

/// Returns its exit status.
int VideoFile::end() {
  if (socket_ >= 0) ::close(std::exchange(socket_, -1));
  int status = 0;
  if (encoder_ > 0) ::waitpid(std::exchange(encoder_, -1), &status, 0);
  return status;
}

void VideoFile::finish() {
  if (end() != 0) throw InputError(file_.string(), "ffmpeg has failed; it says why above");
}

}  // namespace lockbox::app
