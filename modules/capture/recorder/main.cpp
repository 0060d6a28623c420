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

constexpr std::uint32_t kIntegerProperty = 3;
constexpr std::uint32_t kDataBegin = 8;
constexpr std::uint32_t kNewData = 10;
constexpr int kQueuedFrames = 64;  // that the recorder may fall behind: it would queue all memory

/// Follows the records of a recording that is being written.
class GrowingFile {
 public:
  explicit GrowingFile(const std::filesystem::path& file) : file_(file) {}

  /// Type of the last complete record.
  std::uint32_t last_type() const { return last_type_; }
  int frame_count() const { return frame_count_; }

  void update() {
    std::ifstream in(file_, std::ios::binary | std::ios::ate);
    const std::streamoff end = in.tellg();
    std::array<std::uint32_t, 5> header{};  // magic, type, node, size of fields, size of payload
    while (in.seekg(next_) && in.read(reinterpret_cast<char*>(header.data()), sizeof(header)) &&
           next_ + std::streamoff{header[3]} + std::streamoff{header[4]} <= end) {
      next_ += std::streamoff{header[3]} + std::streamoff{header[4]};
      last_type_ = header[1];
      frame_count_ += header[1] == kNewData ? 1 : 0;
    }
  }

  /// Waits until the last record is of this type.
  void wait_for(std::uint32_t type) {
    for (int i = 0; i < 5000; ++i) {
      update();
      if (last_type_ == type) {
        return;
      }
      std::this_thread::sleep_for(2ms);
    }
    throw lockbox::DeviceError(file_.string() + ": OpenNI2 does not record; is the disk full?");
  }

 private:
  std::filesystem::path file_;
  std::streamoff next_ = 24;  // behind the header of the file
  std::uint32_t last_type_ = 0;
  int frame_count_ = 0;
};

/// An OpenNI2 recorder of one stream, ready when it is constructed.
class StreamRecorder {
 public:
  StreamRecorder(openni::VideoStream& stream, const std::filesystem::path& file, bool is_virtual)
      : stream_(stream), file_(file), is_virtual_(is_virtual) {
    if (recorder_.create(file.c_str()) != openni::STATUS_OK ||
        recorder_.attach(stream) != openni::STATUS_OK || recorder_.start() != openni::STATUS_OK) {
      throw lockbox::DeviceError(file.string() +
                                 ": OpenNI2 cannot record: " + lockbox::openni_error());
    }
    wait_until_started();
  }

  /// Writes what is queued, and the end of the file.
  ~StreamRecorder() {
    recorder_.stop();
    recorder_.destroy();
  }
  StreamRecorder(const StreamRecorder&) = delete;
  StreamRecorder& operator=(const StreamRecorder&) = delete;

  /// Lets the virtual device deliver a few frames more than are on disk. The first ones come after
  /// start() of the stream has returned, before which OpenNI2 would drop them.
  void allow_frames() {
    if (is_virtual_) {
      file_.update();
      stream_.setProperty(lockbox::kVirtualDepthLimit, file_.frame_count() + kQueuedFrames);
    }
  }

 private:
  /// The recorder works in a thread of its own and silently drops frames until a few instructions
  /// after it has written "data begin", which on a busy machine can take any time. It takes
  /// messages in turn, frames and changes of properties alike; so a property that was set after
  /// "data begin" and has reached the file is the proof. Real devices are spared that: the frames
  /// that they deliver meanwhile are not missed.
  void wait_until_started() {
    file_.wait_for(kDataBegin);
    if (is_virtual_) {
      stream_.setProperty(XN_STREAM_PROPERTY_HOLE_FILTER, 0);
      file_.wait_for(kIntegerProperty);
    }
  }

  openni::VideoStream& stream_;
  GrowingFile file_;
  bool is_virtual_;
  openni::Recorder recorder_;
};

void record(const std::string& uri, const std::string& file) {
  openni::Device device;
  openni::VideoStream depth;
  lockbox::open_depth(uri, device, depth);
  {
    const lockbox::UnplugWatch watch(device);
    StreamRecorder recorder(depth, file, uri.rfind(lockbox::kVirtualDepthPrefix, 0) == 0);
    if (depth.start() != openni::STATUS_OK) {
      throw lockbox::DeviceError(uri + ": the device does not start: " + lockbox::openni_error());
    }
    do {
      recorder.allow_frames();
    } while (!watch.unplugged() && !stop_is_asked_within(5));
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
