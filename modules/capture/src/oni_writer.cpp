// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/capture/oni_writer.hpp"

#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>
#include <fstream>
#include <string_view>
#include <thread>
#include <vector>

#include "image_limits.hpp"
#include "lockbox/capture/depth_mode.hpp"
#include "lockbox/capture/frame_source.hpp"
#include "lockbox/capture/oni_player.hpp"
#include "lockbox/capture/oni_validator.hpp"
#include "lockbox/capture/virtual_depth.hpp"
#include "lockbox/capture/virtual_depth_protocol.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/core/readable_text.hpp"
#include "recorder_process.hpp"

namespace lockbox {
namespace {

/// Changes what the encoder of OpenNI2 would change, or worse, into something defined.
void make_encodable(std::vector<std::uint16_t>& depth) {
  for (std::uint16_t& value : depth) {
    if (value == 65535) {  // beyond the encoder's table
      value = 0;
    }
  }
  // A run of equal pixels and a last one that differs come out in the wrong order.
  const std::size_t n = depth.size();
  if (depth[n - 4] == depth[n - 3] && depth[n - 3] == depth[n - 2]) {
    depth[n - 1] = depth[n - 2];
  }
}

std::size_t digest(const std::vector<std::uint16_t>& depth) {
  return std::hash<std::string_view>()(std::string_view(reinterpret_cast<const char*>(depth.data()),
                                                        depth.size() * sizeof(std::uint16_t)));
}

/// Requires the folder for what is compared at the end: it is better to hear of it before.
void require_temporary_folder() {
  static_cast<void>(std::filesystem::temp_directory_path());
}

/// The recording will take the place of what has this name, and no other recording meanwhile.
void lock_replaceable(const std::filesystem::path& file, std::optional<RecordingLock>& lock) {
  if (std::filesystem::exists(file) && !std::filesystem::is_regular_file(file)) {
    throw InputError(file.string(), "is not a regular file; a recording becomes one");
  }
  lock.emplace(file);
  const bool is_new = !std::filesystem::exists(file);
  if (!std::ofstream(file, std::ios::binary | std::ios::app)) {
    throw InputError(file.string(), "cannot be written; does its folder exist, is it writable?");
  }
  if (is_new) {
    std::filesystem::remove(file);
  }
}

/// OpenNI2 leaves as many zero bytes behind the end mark as there are bytes before it.
void cut_tail(const std::filesystem::path& file) {
  std::filesystem::resize_file(file, validate_oni(file).end);
}

std::array<int, 2> connected_sockets(const std::filesystem::path& recording) {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    throw DeviceError(recording.string() +
                      ": no socket to its recorder can be made: " + std::strerror(errno));
  }
  return ends;
}

/// What was written of a frame, to compare with what comes back.
struct Written {
  double stamp;
  std::size_t digest;
};

}  // namespace

struct OniWriter::Impl {
  Impl(const std::filesystem::path& path, const PinholeCamera& pinhole, int frames_per_second,
       float metres_per_unit, const std::string& from)
      : Impl(path, pinhole, frames_per_second, metres_per_unit, from, connected_sockets(path)) {}

  Impl(const std::filesystem::path& path, const PinholeCamera& pinhole, int frames_per_second,
       float metres_per_unit, const std::string& from, std::array<int, 2> ends)
      : file(path),
        camera(pinhole),
        unit(metres_per_unit),
        first(from),
        sender(std::in_place, ends[0], pinhole, frames_per_second, metres_per_unit,
               from.empty() ? path.string() : from) {
    try {
      require_temporary_folder();
      lock_replaceable(path, lock);
      recorder.emplace(
          std::string(kVirtualDepthPrefix) + "fd:" + std::to_string(RecorderProcess::kSocket), "",
          path, *lock, ends[1]);
    } catch (...) {
      ::close(ends[1]);
      throw;
    }
    ::close(ends[1]);
  }

  void check(const DepthFrame& frame, const std::string& from) const {
    const std::string where = from.empty() ? file.string() : from;
    const std::string name = "frame " + std::to_string(frame.index);
    const std::string began = first.empty() || first == from ? "" : ", as " + first;
    const auto refuse = [&](const std::string& what, const std::string& its,
                            const std::string& ours) {
      throw InputError(where, name + " has another " + what + " (" + its + ") than the recording " +
                                  file.string() + " (" + ours + began + "), which ends before it");
    };
    if (!(frame.camera == camera)) {
      refuse("camera", size_text(frame.camera.width, frame.camera.height),
             size_text(camera.width, camera.height));
    }
    if (frame.metres_per_unit != unit) {
      refuse("depth unit", readable_length(frame.metres_per_unit), readable_length(unit));
    }
    if (!(frame.stamp >= 0.0) || (!written.empty() && frame.stamp <= written.back().stamp)) {
      throw InputError(where, name + ": the stamps of frames must increase, from 0 s at least");
    }
  }

  /// Ends the recording: to the recorder the device is unplugged. It takes what is still under way,
  /// and ends.
  void close() {
    sender.reset();
    while (recorder->is_running()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }

  void verify() const {
    OniPlayer player(file);
    DepthFrame frame;
    std::size_t count = 0;
    for (; count < written.size() && player.next(frame); ++count) {
      const double stamp = written[count].stamp - written.front().stamp;
      if (digest(frame.depth) != written[count].digest || std::abs(frame.stamp - stamp) > 2e-6) {
        throw DeviceError(file.string() + ": frame " + std::to_string(count) +
                          " was recorded wrongly by OpenNI2");
      }
    }
    if (count != written.size() || player.frame_count() != count) {
      throw DeviceError(file.string() + ": OpenNI2 recorded " +
                        std::to_string(*player.frame_count()) + " of " +
                        std::to_string(written.size()) + " frames; is the disk full?");
    }
  }

  std::filesystem::path file;
  PinholeCamera camera;
  float unit;
  std::string first;  ///< the file of the first frame
  std::optional<VirtualDepthSender> sender;
  std::optional<RecordingLock> lock;
  std::optional<RecorderProcess> recorder;
  DepthFrame encodable;
  std::vector<Written> written;
};

OniWriter::OniWriter(const std::filesystem::path& file, const PinholeCamera& camera,
                     int frames_per_second, float metres_per_unit, const std::string& from)
    : impl_(std::make_unique<Impl>(file, camera, frames_per_second, metres_per_unit, from)) {}

OniWriter::~OniWriter() {
  impl_->close();
}

void OniWriter::write(const DepthFrame& frame, const std::string& from) {
  impl_->check(frame, from);
  impl_->encodable = frame;
  make_encodable(impl_->encodable.depth);
  try {
    impl_->sender->send(impl_->encodable);
  } catch (const DeviceError&) {
    impl_->recorder->finish();  // knows the reason
    throw;
  }
  impl_->written.push_back({frame.stamp, digest(impl_->encodable.depth)});
}

void OniWriter::finish() {
  impl_->close();
  if (impl_->written.empty()) {
    throw InputError(impl_->file.string(), "there were no frames to write");
  }
  impl_->recorder->finish();
  cut_tail(impl_->file);
  impl_->verify();
}

std::size_t write_oni(const std::filesystem::path& file, const PinholeCamera& camera,
                      int frames_per_second, const std::function<bool(DepthFrame&)>& next_frame) {
  DepthFrame frame;
  frame.camera = camera;
  if (!next_frame(frame)) {
    throw InputError(file.string(), "there are no frames to write");
  }
  OniWriter writer(file, camera, frames_per_second, frame.metres_per_unit);
  std::size_t count = 0;
  do {
    writer.write(frame);
    ++count;
  } while (next_frame(frame));
  writer.finish();
  return count;
}

namespace {

std::size_t record_device(const std::string& uri, const std::filesystem::path& file,
                          const RecordingEnd& end, const SourceOptions& options) {
  using Seconds = std::chrono::duration<double>;
  std::optional<RecordingLock> lock;
  lock_replaceable(file, lock);
  RecorderProcess recorder(uri, options.mode ? to_string(*options.mode) : "", file, *lock);
  const auto start = std::chrono::steady_clock::now();
  while (recorder.is_running() && !end.stop() &&
         Seconds(std::chrono::steady_clock::now() - start).count() < end.seconds) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  const bool is_unplugged = !recorder.is_running();
  recorder.finish();
  if (is_unplugged && options.warn) {
    options.warn(
        "the device was unplugged, and the recording ends there (one that goes on when it is back "
        "is made by `lockbox track --record`)");
  }
  cut_tail(file);
  return validate_oni(file).frame_count;
}

}  // namespace

std::size_t record(const std::string& source, const std::filesystem::path& file,
                   const RecordingEnd& end, const SourceOptions& options) {
  constexpr std::string_view kLive = "openni2:";
  if (source.starts_with(kLive)) {
    if (options.warn && (options.camera_info || options.depth_scale)) {
      options.warn(
          "a device is recorded as it is: calibration and depth scale (--camera-info, "
          "--depth-scale) are not used");
    }
    return record_device(source.substr(kLive.size()), file, end, options);
  }
  const std::unique_ptr<FrameSource> recording = open_source(source, options);
  DepthFrame frame;
  if (!recording->next(frame)) {
    throw InputError(source, "delivered no frame");
  }
  constexpr int kNominalRate = 30;  // frames per second; the stamps say when they really came
  const double last_stamp = frame.stamp + end.seconds;
  OniWriter writer(file, frame.camera, kNominalRate, frame.metres_per_unit,
                   recording->file_of_frame());
  std::size_t count = 0;
  do {
    writer.write(frame, recording->file_of_frame());
    ++count;
  } while (!end.stop() && recording->next(frame) && frame.stamp < last_stamp);
  writer.finish();
  return count;
}

}  // namespace lockbox
