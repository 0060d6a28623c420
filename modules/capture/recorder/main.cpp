// SPDX-License-Identifier: BSD-3-Clause
// lockbox-oni-recorder URI FILE [MODE]: records the depth of an OpenNI2 device until the device is
// unplugged, standard input is closed, or the disk is full. The recording grows in FILE.part and
// takes the place of FILE when it is complete. Started by the capture library.
#include <OpenNI.h>
#include <PS1080.h>
#include <poll.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <thread>

#include "growing_name.hpp"
#include "growing_recording.hpp"
#include "lockbox/capture/depth_mode.hpp"
#include "lockbox/capture/virtual_depth_protocol.hpp"
#include "lockbox/core/error.hpp"
#include "openni_device.hpp"
#include "openni_session.hpp"

namespace {

using namespace std::chrono_literals;
using Mode = std::optional<lockbox::WantedMode>;

bool stop_is_asked_within(int milliseconds) {
  pollfd input{STDIN_FILENO, POLLIN, 0};
  return ::poll(&input, 1, milliseconds) > 0;
}

constexpr int kQueuedFrames = 16;  // that the recorder may fall behind: it would queue all memory

/// An OpenNI2 recorder of one stream, ready when it is constructed.
class StreamRecorder {
 public:
  StreamRecorder(openni::VideoStream& stream, const std::filesystem::path& file, bool is_virtual)
      : stream_(stream), file_(file), is_virtual_(is_virtual) {
    hold_frames();
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
  /// start() of the stream has returned.
  void allow_frames() {
    if (is_virtual_) {
      file_.update();
      stream_.setProperty(lockbox::kVirtualDepthLimit, file_.frame_count() + kQueuedFrames);
    }
  }

 private:
  /// OpenNI2 drops what a device delivers before start() of the stream has returned, which on a
  /// busy machine can take any time. Frames that are dropped count as delivered, but are never on
  /// disk: after a few of them the device would deliver nothing any more.
  void hold_frames() {
    if (is_virtual_) {
      stream_.setProperty(lockbox::kVirtualDepthLimit, 0);
    }
  }

  /// The recorder works in a thread of its own and silently drops frames until a few instructions
  /// after it has written "data begin", which on a busy machine can take any time. It takes
  /// messages in turn, frames and changes of properties alike; so a property that was set after
  /// "data begin" and has reached the file is the proof. Real devices are spared that: the frames
  /// that they deliver meanwhile are not missed.
  void wait_until_started() {
    file_.wait_for(lockbox::OniRecordType::data_begin);
    if (is_virtual_) {
      stream_.setProperty(XN_STREAM_PROPERTY_HOLE_FILTER, 0);
      file_.wait_for(lockbox::OniRecordType::int_property);
    }
  }

  openni::VideoStream& stream_;
  lockbox::GrowingRecording file_;
  bool is_virtual_;
  openni::Recorder recorder_;
};

/// What must stay free for the frames under way and the tables at the end, bytes.
std::uintmax_t reserve(const openni::VideoStream& depth) {
  constexpr std::uintmax_t kTables = 1U << 20U;
  const openni::VideoMode mode = depth.getVideoMode();
  return kTables + std::uintmax_t{kQueuedFrames} * sizeof(std::uint16_t) *
                       static_cast<std::uintmax_t>(mode.getResolutionX() * mode.getResolutionY());
}

/// Returns false if the disk was full before the device was unplugged or a stop asked for.
bool record_until_stopped(const std::string& uri, const Mode& mode,
                          const std::filesystem::path& file) {
  openni::Device device;
  openni::VideoStream depth;
  lockbox::open_depth(uri, mode, device, depth);
  const std::uintmax_t least_room = reserve(depth);
  bool has_room = true;
  if (lockbox::room_for(file) < least_room) {
    throw lockbox::DeviceError(file.string() + ": the disk is full");
  }
  {
    const lockbox::UnplugWatch watch(device);
    StreamRecorder recorder(depth, file, uri.rfind(lockbox::kVirtualDepthPrefix, 0) == 0);
    if (depth.start() != openni::STATUS_OK) {
      throw lockbox::DeviceError(uri + ": the device does not start: " + lockbox::openni_error());
    }
    do {
      recorder.allow_frames();
      has_room = lockbox::room_for(file) > least_room;
    } while (has_room && !watch.unplugged() && !stop_is_asked_within(5));
    depth.stop();
  }
  depth.destroy();
  device.close();
  return has_room;
}

void record(const std::string& uri, const Mode& mode, const std::filesystem::path& file) {
  const std::filesystem::path unfinished = lockbox::growing_name(file);
  try {
    const bool has_room = record_until_stopped(uri, mode, unfinished);
    const int frames = lockbox::complete_frames(unfinished);
    if (frames > 0) {
      std::filesystem::rename(unfinished, file);
    }
    if (!has_room) {
      throw lockbox::DeviceError(file.string() + ": the disk is full; " + std::to_string(frames) +
                                 " frames were recorded");
    }
    if (frames == 0) {
      throw lockbox::DeviceError(uri + ": the device has delivered no frame");
    }
  } catch (...) {
    std::error_code is_gone;
    std::filesystem::remove(unfinished, is_gone);
    throw;
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3 || argc > 4) {
    std::fprintf(stderr, "usage: lockbox-oni-recorder URI FILE [MODE]\n");
    return 2;
  }
  // Signals reach the whole process group; the recording ends when the caller says so, or ends. A
  // file that may not grow further is like a full disk.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXFSZ}) {
    std::signal(signal, SIG_IGN);
  }
  try {
    record(argv[1], argc == 4 ? Mode(lockbox::parse_depth_mode(argv[3])) : std::nullopt, argv[2]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
