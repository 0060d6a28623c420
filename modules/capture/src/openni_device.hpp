// SPDX-License-Identifier: BSD-3-Clause
// Opening and watching live devices. Only sources of this module include it.
#pragma once

#include <OpenNI.h>

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "lockbox/capture/frame_source.hpp"

namespace lockbox {

/// Whether it is one of the two units in which depth is taken.
bool is_depth_format(openni::PixelFormat format);

/// The devices that OpenNI2 lists, without recordings.
std::vector<openni::DeviceInfo> live_devices();

/// That there is no device, why, and what to do.
std::string absence_text();

DepthMode described(const openni::VideoMode& mode);

/// The modes of a depth stream whose depths lockbox reads.
std::vector<DepthMode> depth_modes(const openni::VideoStream& depth);

/// Opens the device with this URI, or the first live one if it is empty, and creates its depth
/// stream: un-mirrored where the device can, in the mode that is wanted, or as near to 640x480,
/// 30 Hz, 1 mm as it can. Throws DeviceError.
void open_depth(const std::string& uri, const std::optional<WantedMode>& wanted,
                openni::Device& device, openni::VideoStream& depth);

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
