// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/capture/live_device.hpp"

#include <chrono>
#include <optional>
#include <thread>
#include <utility>

#include "continued_frames.hpp"
#include "live_connection.hpp"
#include "lockbox/capture/depth_mode.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/core/readable_text.hpp"
#include "openni_session.hpp"
#include "rectification.hpp"

namespace lockbox {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kLookMilliseconds = 100;  // between looks at whether the device is still there
constexpr double kSilence = 1.0;        // seconds without a frame that are worth a word
constexpr double kReopening = 0.5;      // seconds between attempts

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::string seconds_text(double seconds) {
  constexpr int kDigits = 2;
  return readable_number(seconds, kDigits) + " s";
}

PinholeCamera own_camera(LiveConnection& connection, const SourceOptions& options) {
  const openni::VideoMode mode = connection.depth().getVideoMode();
  const int width = mode.getResolutionX();
  const int height = mode.getResolutionY();
  const auto angles = field_of_view(connection.depth());
  if (!angles && !options.camera && !options.camera_info) {
    throw DeviceError(std::string(connection.info().getUri()) +
                      ": the device does not tell its field of view; give the camera's "
                      "calibration with --camera-info");
  }
  return angles ? camera_of(*angles, width, height)
                : PinholeCamera{width, height, 0.0, 0.0, 0.0, 0.0};
}

}  // namespace

/// Follows the device over the times when it is away or silent.
struct LiveDevice::Impl {
  Impl(const std::string& uri, const SourceOptions& source_options)
      : options(source_options), rectification(given_calibration(source_options)) {
    connection.emplace(uri, options.mode);
    name = connection->info().getUri();
    mode = described(connection->depth().getVideoMode());
    camera = own_camera(*connection, options);
    rectification.check_size(camera.width, camera.height, name);
    returned.emplace(connection->info());
    connection->start();
  }

  /// Returns false if it was told to stop.
  bool wait() {
    const auto start = Clock::now();
    bool is_told = false;
    while (!connection || !wait_for_frame(connection->depth(), kLookMilliseconds)) {
      if (options.stop && options.stop()) return false;
      if (connection && connection->is_unplugged()) {
        connection.reset();
        tell("the device was unplugged", is_told);
      } else if (connection && seconds_since(start) > kSilence) {
        tell("the device has delivered no frame for " + seconds_text(kSilence), is_told);
      }
      if (seconds_since(start) > options.patience) give_up();
      if (!connection) try_again();
    }
    if (is_told) {
      ++outages;
      warn("it delivers frames again, after " + seconds_text(seconds_since(start)));
    }
    return true;
  }

  /// Nothing if the device went just then.
  std::optional<openni::VideoFrameRef> read() {
    openni::VideoFrameRef frame;
    if (connection->depth().readFrame(&frame) == openni::STATUS_OK) return frame;
    if (connection->is_unplugged()) return std::nullopt;
    throw DeviceError(name + ": a frame cannot be read: " + openni_error());
  }

  void deliver(const openni::VideoFrameRef& read, DepthFrame& frame) {
    frame.camera = camera;
    copy_frame(read, connection->is_mirrored(), name, frame);
    frames.add(read.getFrameIndex(), Clock::now(), frame);
    rectification.apply(frame);
  }

 private:
  void tell(const std::string& what, bool& is_told) const {
    if (std::exchange(is_told, true)) return;
    warn(what + "; waiting for it, " + seconds_text(options.patience) + " at most");
  }

  void warn(const std::string& what) const {
    if (options.warn) options.warn(name + ": " + what);
  }

  [[noreturn]] void give_up() const {
    const std::string waited = seconds_text(options.patience);
    throw DeviceError(name + (connection ? ": the device has delivered no frame for " + waited +
                                               "; check its cable and whether another program uses "
                                               "it"
                                         : ": the device was unplugged, and did not come back "
                                           "within " +
                                               waited));
  }

  /// Whether the device is back.
  void try_again() {
    if (seconds_since(last_try) < kReopening) {
      std::this_thread::sleep_for(std::chrono::milliseconds(kLookMilliseconds));
      return;
    }
    last_try = Clock::now();
    for (const auto& uri : returned->candidates()) {
      try {
        connection.emplace(uri, options.mode);
        require_same_camera();
        connection->start();
        frames.reopen();
        return;
      } catch (const DeviceError&) {
        connection.reset();  // not yet there
      }
    }
  }

  void require_same_camera() {
    if (own_camera(*connection, options) == camera) return;
    throw InputError(name,
                     "the device has come back with another image size or field of view; "
                     "begin anew");
  }

 public:
  SourceOptions options;
  Rectification rectification;
  std::optional<LiveConnection> connection;  ///< none while the device is away
  std::optional<ReturnOfDevice> returned;
  std::string name;
  DepthMode mode;
  PinholeCamera camera;
  Clock::time_point last_try;
  ContinuedFrames frames;
  std::size_t outages = 0;
};

LiveDevice::LiveDevice(const std::string& uri, const SourceOptions& options)
    : impl_(std::make_unique<Impl>(uri, options)) {}

LiveDevice::~LiveDevice() = default;

bool LiveDevice::next(DepthFrame& frame) {
  std::optional<openni::VideoFrameRef> read;
  while (!read) {
    if (!impl_->wait()) return false;
    read = impl_->read();
  }
  impl_->deliver(*read, frame);
  return true;
}

SourceFaults LiveDevice::faults() const {
  return {.dropped = impl_->frames.dropped(), .outages = impl_->outages};
}

std::string LiveDevice::description() const {
  return "OpenNI2 device " + impl_->name + ", " + to_string(impl_->mode);
}

}  // namespace lockbox
