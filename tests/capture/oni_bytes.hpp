// SPDX-License-Identifier: BSD-3-Clause
// .oni files as bytes, to damage and to change, and to play in a child process, which may crash.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "lockbox/capture/oni_player.hpp"
#include "lockbox/capture/oni_writer.hpp"
#include "lockbox/core/error.hpp"
#include "synthetic_frames.hpp"
#include "temporary_folder.hpp"

namespace lockbox {

inline constexpr std::size_t kFramesOfSound = 4;

// Types of records.
inline constexpr std::uint32_t kGeneralProperty = 0x6;
inline constexpr std::uint32_t kNodeAdded = 0xD;
inline constexpr std::uint32_t kSeekTable = 0xE;

template <typename T>
T value_at(const std::string& bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, &bytes[offset], sizeof(T));
  return value;
}

inline void write_file(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

inline std::string read_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Runs work in a child process, because what it does may crash, and returns its exit status, or
/// minus the signal that ended it: that of the alarm if it hung.
inline int status_of_child(const std::function<int()>& work) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::alarm(200);  // seconds by the clock: the machine may be busy
    try {
      ::_exit(work());
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s\n", error.what());
      ::_exit(99);
    }
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

/// The bytes of a small sound recording.
inline std::string sound_recording(const TemporaryFolder& folder) {
  const std::filesystem::path file = folder / "sound.oni";
  const auto record = [&file] {
    OniWriter writer(file, tiny_camera(), 30);
    for (std::uint64_t number = 0; number < kFramesOfSound; ++number) {
      writer.write(synthetic_frame(number, tiny_camera()));
    }
    writer.finish();
    return 0;
  };
  if (status_of_child(record) != 0) {
    throw std::runtime_error("no recording");
  }
  return read_file(file);
}

/// How it went to play a file.
enum Replay { kComplete = 0, kRefused = 10, kIncomplete = 11 };

inline Replay replay(const std::filesystem::path& file) {
  DepthFrame frame;
  std::size_t count = 0;
  try {
    OniPlayer player(file);
    while (player.next(frame)) {
      ++count;
    }
    return count == player.frame_count() ? kComplete : kIncomplete;
  } catch (const InputError&) {
    return kRefused;
  }
}

/// Offsets of all records of a sound recording, and of its end.
inline std::vector<std::size_t> record_offsets(const std::string& bytes) {
  std::vector<std::size_t> offsets;
  for (std::size_t offset = 24; offset < bytes.size();) {
    offsets.push_back(offset);
    std::uint32_t fields = 0;
    std::uint32_t payload = 0;
    std::memcpy(&fields, &bytes[offset + 12], 4);
    std::memcpy(&payload, &bytes[offset + 16], 4);
    offset += std::size_t{fields} + payload;
  }
  offsets.push_back(bytes.size());
  return offsets;
}

}  // namespace lockbox
