// SPDX-License-Identifier: BSD-3-Clause
// A live device from when it is opened until it is closed or unplugged. Only sources of this module
// include it.
#pragma once

#include <OpenNI.h>

#include <string>
#include <vector>

#include "openni_device.hpp"

namespace lockbox {

class LiveConnection {
 public:
  /// Opens the device with this URI, or the first one if it is empty, as open_depth() does.
  LiveConnection(const std::string& uri, const std::optional<WantedMode>& mode);
  ~LiveConnection();
  LiveConnection(const LiveConnection&) = delete;
  LiveConnection& operator=(const LiveConnection&) = delete;

  /// It delivers frames from now on. Throws DeviceError.
  void start();

  openni::VideoStream& depth() { return depth_; }
  const openni::DeviceInfo& info() const { return device_.getDeviceInfo(); }
  bool is_unplugged() const { return unplug_watch_.unplugged(); }

  /// Whether its images are, although it was told otherwise. It was asked before it was started:
  /// properties of streams are not read while the driver's thread works with them.
  bool is_mirrored() const { return is_mirrored_; }

 private:
  /// Closed if what comes later in the constructor throws.
  openni::Device device_;
  openni::VideoStream depth_;
  UnplugWatch unplug_watch_;
  bool is_mirrored_;
};

/// What a device that was unplugged may be called when it comes back. USB devices are named by the
/// place where they are plugged in, and by a number that is new each time: those of the same kind
/// that have come since are meant.
class ReturnOfDevice {
 public:
  /// Waits for the device. It has to be made while the device is there.
  explicit ReturnOfDevice(const openni::DeviceInfo& device);

  std::vector<std::string> candidates() const;

 private:
  openni::DeviceInfo device_;
  std::vector<std::string> others_;  ///< that were there, too
};

}  // namespace lockbox
