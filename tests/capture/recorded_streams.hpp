// SPDX-License-Identifier: BSD-3-Clause
// Recordings of several streams, made by OpenNI2's own recorder.
#pragma once

#include <OpenNI.h>
#include <sys/socket.h>

#include <array>
#include <chrono>
#include <deque>
#include <filesystem>
#include <future>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "growing_recording.hpp"
#include "lockbox/capture/virtual_depth.hpp"
#include "lockbox/capture/virtual_depth_protocol.hpp"
#include "synthetic_frames.hpp"

namespace lockbox {

/// Pixels from (x, y) on.
struct Region {
  int x;
  int y;
  int width;
  int height;
};

/// Which streams are attached to a recorder, in order, and how.
struct Streams {
  std::vector<openni::SensorType> order;
  bool lossy = false;
  bool mirrored = false;
  std::optional<Region> cropping = std::nullopt;
};

inline void PrintTo(const Streams& streams, std::ostream* out) {
  *out << streams.order.size() << " streams";
}

/// What is attached to one recorder.
class StreamsOfDevice {
 public:
  StreamsOfDevice(openni::Device& device, const Streams& streams) {
    for (const openni::SensorType type : streams.order) {
      openni::VideoStream& stream = streams_.emplace_back();
      require(stream.create(device, type));
      stream.setMirroringEnabled(streams.mirrored);
    }
    if (streams.cropping) {
      crop(*streams.cropping);
    }
  }
  ~StreamsOfDevice() {
    for (openni::VideoStream& stream : streams_) {
      stream.stop();
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(30));  // as the player demands
    for (openni::VideoStream& stream : streams_) {
      stream.destroy();
    }
  }
  StreamsOfDevice(const StreamsOfDevice&) = delete;
  StreamsOfDevice& operator=(const StreamsOfDevice&) = delete;

  static void require(openni::Status status) {
    if (status != openni::STATUS_OK) {
      throw std::runtime_error(openni::OpenNI::getExtendedError());
    }
  }

  void attach_to(openni::Recorder& recorder, bool lossy) {
    for (openni::VideoStream& stream : streams_) {
      require(recorder.attach(stream, lossy));
    }
  }

  void start() {
    for (openni::VideoStream& stream : streams_) {
      require(stream.start());
    }
  }

  void crop(const Region& region) {
    for (openni::VideoStream& stream : streams_) {
      require(stream.setCropping(region.x, region.y, region.width, region.height));
    }
  }

  void allow_frames(int count) { streams_.front().setProperty(kVirtualDepthLimit, count); }

  /// Waits until every stream has delivered this frame, which it reads.
  void read_through(int frame) {
    std::vector<openni::VideoStream*> waiting;
    for (openni::VideoStream& stream : streams_) {
      waiting.push_back(&stream);
    }
    while (!waiting.empty()) {
      int ready = 0;
      require(openni::OpenNI::waitForAnyStream(waiting.data(), static_cast<int>(waiting.size()),
                                               &ready, 10000));
      openni::VideoFrameRef read;
      require(waiting[static_cast<std::size_t>(ready)]->readFrame(&read));
      if (read.getFrameIndex() == frame) {
        waiting.erase(waiting.begin() + ready);
      }
    }
  }

 private:
  std::deque<openni::VideoStream> streams_;
};

/// The recorder starts in a thread of its own. Frames that come before it are lost; and it must not
/// read the properties of a recording that plays, whose player replaces them without a lock.
inline void start_recorder(openni::Recorder& recorder, const std::filesystem::path& file) {
  StreamsOfDevice::require(recorder.start());
  GrowingRecording(file).wait_for(OniRecordType::data_begin);
  std::this_thread::sleep_for(std::chrono::milliseconds(60));  // a few instructions are left
}

/// Records what the device delivers; prepare is called when the recorder is ready.
template <typename Prepare>
void record_device(openni::Device& device, const std::filesystem::path& file,
                   const Streams& streams, int frames, Prepare prepare) {
  StreamsOfDevice attached(device, streams);
  openni::Recorder recorder;
  StreamsOfDevice::require(recorder.create(file.c_str()));
  attached.attach_to(recorder, streams.lossy);
  start_recorder(recorder, file);
  attached.start();
  prepare(attached);
  attached.read_through(frames);
  recorder.stop();
  recorder.destroy();
}

/// Records synthetic frames of the virtual camera; prepare, which is called when the recorder is
/// ready, allows them.
template <typename Prepare>
void record_streams(const std::filesystem::path& file, const Streams& streams, int frames,
                    const PinholeCamera& camera, Prepare prepare) {
  StreamsOfDevice::require(openni::OpenNI::initialize());
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    throw std::runtime_error("no sockets");
  }
  VirtualDepthSender sender(ends[0], camera, 30, 0.001F, file.string());
  openni::Device device;
  const std::string uri = std::string(kVirtualDepthPrefix) + "fd:" + std::to_string(ends[1]);
  StreamsOfDevice::require(device.open(uri.c_str()));
  const auto sent = std::async(std::launch::async, [&] {
    for (int number = 0; number < frames; ++number) {
      sender.send(synthetic_frame(static_cast<std::uint64_t>(number), camera));
    }
  });
  record_device(device, file, streams, frames, prepare);
  device.close();
}

inline void record_streams(const std::filesystem::path& file, const Streams& streams, int frames,
                           const PinholeCamera& camera) {
  record_streams(file, streams, frames, camera,
                 [frames](StreamsOfDevice& attached) { attached.allow_frames(frames); });
}

/// Records another recording, of so many frames, anew.
inline void record_again(const std::filesystem::path& recording, const std::filesystem::path& file,
                         const Streams& streams, int frames) {
  openni::Device device;
  StreamsOfDevice::require(device.open(recording.c_str()));
  constexpr float kFrameByFrame = -1.0F;
  StreamsOfDevice::require(device.getPlaybackControl()->setSpeed(kFrameByFrame));
  record_device(device, file, streams, frames, [](StreamsOfDevice&) {});
  device.close();
}

}  // namespace lockbox
