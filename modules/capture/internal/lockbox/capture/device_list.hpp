// SPDX-License-Identifier: BSD-3-Clause
// What OpenNI2 sees of depth cameras.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lockbox/capture/frame_source.hpp"
#include "lockbox/core/depth_frame.hpp"

namespace lockbox {

struct ListedDevice {
  std::string uri;  ///< for `openni2:<uri>`
  std::string vendor;
  std::string name;
  int usb_vendor = 0;   ///< 0 if it is no USB device, as usb_product
  int usb_product = 0;  ///< USB's id
  /// Why its depth stream does not open, and what to do; then all below is empty.
  std::optional<std::string> problem;
  std::vector<DepthMode> modes;
  std::optional<DepthMode> chosen;      ///< the one that LiveDevice takes unasked
  std::optional<PinholeCamera> camera;  ///< of that mode, if the device tells its field of view
};

/// The live devices that OpenNI2 sees by itself, and those with these URIs, which it may know
/// without seeing them. The depth stream of each is opened, and closed again without being started.
/// Throws DeviceError if OpenNI2 does not start.
std::vector<ListedDevice> list_devices(const std::vector<std::string>& uris = {});

/// Why OpenNI2 sees no device by itself, as far as the system tells, and what to do. Throws
/// DeviceError if OpenNI2 does not start.
std::string why_no_device();

}  // namespace lockbox
