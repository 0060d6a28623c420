// SPDX-License-Identifier: BSD-3-Clause
// lockbox-oni-recorder URI FILE: records the depth of an OpenNI2 device until the device is
// unplugged or standard input is closed. Started by the capture library.
#include <OpenNI.h>
#include <PS1080.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <thread>

#include "lockbox/capture/virtual_depth_protocol.hpp"
#include "lockbox/core/error.hpp"
#include "openni_device.hpp"
#include "openni_session.hpp"

namespace {

using namespace std::chrono_literals;

bool stop_is_asked_within(int milliseconds) {
  pollfd input{STDIN_FILENO, POLLIN, 0};
  return ::poll(&input, 1, milliseconds) > 0;
}

/// An OpenNI2 recorder of one stream, ready when it is constructed. It works in a thread of its own
/// and silently drops frames until a few instructions after it has written "data begin", which on a
/// busy machine can take any time. It takes messages in turn, frames and changes of properties
/// alike; so a property that was set after "data begin" and has reached the file is the proof.
class StreamRecorder {
 public:
  /// is_virtual: setting a property does nothing to the device. Real devices are spared: the frames
  /// that they deliver meanwhile are not missed.
  StreamRecorder(openni::VideoStream& stream, const std::filesystem::path& file, bool is_virtual)
      : file_(file) {
    if (recorder_.create(file.c_str()) != openni::STATUS_OK ||
        recorder_.attach(stream) != openni::STATUS_OK || recorder_.start() != openni::STATUS_OK) {
      throw lockbox::DeviceError(file.string() +
                                 ": OpenNI2 cannot record: " + lockbox::openni_error());
    }
    wait_for_record(kDataBegin, kDataBeginSize);
    if (is_virtual) {
      stream.setProperty(XN_STREAM_PROPERTY_HOLE_FILTER, 0);
      wait_for_record(kIntegerProperty, kPropertySize);
    }
  }

  /// Writes what is queued, and the end of the file.
  ~StreamRecorder() {
    recorder_.stop();
    recorder_.destroy();
  }
  StreamRecorder(const StreamRecorder&) = delete;
  StreamRecorder& operator=(const StreamRecorder&) = delete;

 private:
  static constexpr std::uint32_t kDataBegin = 8;
  static constexpr std::streamoff kDataBeginSize = 40;
  static constexpr std::uint32_t kIntegerProperty = 3;
  static constexpr std::streamoff kPropertySize = 28 + 4 + sizeof("HoleFilter") + 4 + 8;

  /// Waits until the last record of the file has this type and size.
  void wait_for_record(std::uint32_t type, std::streamoff size) const {
    const std::array<std::uint32_t, 2> expected{0x0052494E, type};
    for (int i = 0; i < 5000; ++i) {
      std::ifstream in(file_, std::ios::binary);
      std::array<std::uint32_t, 2> found{};
      in.seekg(-size, std::ios::end);
      in.read(reinterpret_cast<char*>(found.data()), sizeof(found));
      if (in && found == expected) {
        return;
      }
      std::this_thread::sleep_for(2ms);
    }
    throw lockbox::DeviceError(file_.string() + ": OpenNI2 does not record; is the disk full?");
  }

  std::filesystem::path file_;
  openni::Recorder recorder_;
};

void record(const std::string& uri, const std::string& file) {
  openni::Device device;
  openni::VideoStream depth;
  lockbox::open_depth(uri, device, depth);
  {
    const bool is_virtual = uri.rfind(lockbox::kVirtualDepthPrefix, 0) == 0;
    const lockbox::UnplugWatch watch(device);
    const StreamRecorder recorder(depth, file, is_virtual);
    if (depth.start() != openni::STATUS_OK) {
      throw lockbox::DeviceError(uri + ": the device does not start: " + lockbox::openni_error());
    }
    if (is_virtual) {
      depth.setProperty(lockbox::kVirtualDepthBegin, 1);
    }
    while (!watch.unplugged() && !stop_is_asked_within(20)) {
    }
    depth.stop();
  }
  depth.destroy();
  device.close();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: lockbox-oni-recorder URI FILE\n");
    return 2;
  }
  // An interrupt reaches the whole process group; the recording ends when the caller says so.
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGHUP, SIG_IGN);
  try {
    record(argv[1], argv[2]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
