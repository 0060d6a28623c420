// SPDX-License-Identifier: BSD-3-Clause
// Opening and watching live devices. Only sources of this module include it.
#pragma once

#include <OpenNI.h>

#include <atomic>
#include <string>
#include <vector>

namespace lockbox {

/// Whether it is one of the two units in which depth is taken.
bool is_depth_format(openni::PixelFormat format);

/// The devices that OpenNI2 lists, without recordings.
std::vector<openni::DeviceInfo> live_devices();

/// That there is no device, why, and what to do.
std::string absence_text();

/// Opens the device with this URI, or the first live one if it is empty, and creates its depth
/// stream: un-mirrored where the device can, at 640x480, 30 Hz, 1 mm where there is a choice.
/// Throws DeviceError.
void open_depth(const std::string& uri, openni::Device& device, openni::VideoStream& depth);

/// Learns when a device is unplugged.
class UnplugWatch : public openni::OpenNI::DeviceDisconnectedListener {
 public:
  explicit UnplugWatch(const openni::Device& device);
  ~UnplugWatch() override;
  UnplugWatch(const UnplugWatch&) = delete;
  UnplugWatch& operator=(const UnplugWatch&) = delete;

  bool unplugged() const { return unplugged_; }

 private:
  void onDeviceDisconnected(const openni::DeviceInfo* info) override;

  std::string uri_;
  std::atomic<bool> unplugged_{false};
};

}  // namespace lockbox
