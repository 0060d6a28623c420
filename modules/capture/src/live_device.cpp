// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/capture/live_device.hpp"

#include <algorithm>

#include "lockbox/core/error.hpp"
#include "openni_device.hpp"
#include "openni_session.hpp"
#include "rectification.hpp"

namespace lockbox {
namespace {

constexpr int kLookMilliseconds = 100;  // between looks at whether the device is still there
constexpr int kLooks = 50;

}  // namespace

struct LiveDevice::Impl {
  Impl(const std::string& uri, const SourceOptions& options)
      : rectification(given_calibration(options)), stop(options.stop) {
    open_depth(uri, device, depth);
    name = device.getDeviceInfo().getUri();
    unplug_watch.emplace(device);
    const openni::VideoMode mode = depth.getVideoMode();
    rectification.check_size(mode.getResolutionX(), mode.getResolutionY(), name);
    const std::optional<PinholeCamera> own =
        camera_of(depth, mode.getResolutionX(), mode.getResolutionY());
    if (!own && !options.camera && !options.camera_info) {
      throw DeviceError(name +
                        ": the device does not tell its field of view; give the camera's "
                        "calibration with --camera-info");
    }
    camera = own.value_or(
        PinholeCamera{mode.getResolutionX(), mode.getResolutionY(), 0.0, 0.0, 0.0, 0.0});
    if (depth.start() != openni::STATUS_OK) {
      throw DeviceError(name + ": the device does not start: " + openni_error());
    }
  }

  ~Impl() {
    depth.stop();
    depth.destroy();
    device.close();
  }

  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  /// Returns false if it was told to stop.
  bool wait() {
    for (int slice = 0; !wait_for_frame(depth, kLookMilliseconds); ++slice) {
      if (stop && stop()) {
        return false;
      }
      if (unplug_watch->unplugged()) {
        throw DeviceError(name + ": the device was unplugged");
      }
      if (slice == kLooks) {
        throw DeviceError(name +
                          ": the device has delivered no frame for 5 s; check its cable and "
                          "whether another program uses it");
      }
    }
    return true;
  }

  Rectification rectification;
  std::function<bool()> stop;
  openni::Device device;
  openni::VideoStream depth;
  std::optional<UnplugWatch> unplug_watch;
  std::string name;
  PinholeCamera camera;
  std::optional<int> first_index;
  std::optional<int> last_index;
  std::size_t dropped = 0;
};

LiveDevice::LiveDevice(const std::string& uri, const SourceOptions& options)
    : impl_(std::make_unique<Impl>(uri, options)) {}

LiveDevice::~LiveDevice() = default;

bool LiveDevice::next(DepthFrame& frame) {
  if (!impl_->wait()) {
    return false;
  }
  openni::VideoFrameRef read;
  if (impl_->depth.readFrame(&read) != openni::STATUS_OK) {
    throw DeviceError(impl_->name + ": a frame cannot be read: " + openni_error());
  }
  frame.camera = impl_->camera;
  copy_frame(read, impl_->depth.getMirroringEnabled(), frame);
  const int index = read.getFrameIndex();
  if (!impl_->first_index) {
    impl_->first_index = index;
  }
  frame.index = static_cast<std::uint64_t>(index - *impl_->first_index);
  const int missed = index - impl_->last_index.value_or(index - 1) - 1;
  impl_->dropped += static_cast<std::size_t>(std::max(missed, 0));
  impl_->last_index = index;
  impl_->rectification.apply(frame);
  return true;
}

SourceFaults LiveDevice::faults() const {
  return {.dropped = impl_->dropped};
}

std::string LiveDevice::description() const {
  return "OpenNI2 device " + impl_->name;
}

}  // namespace lockbox
