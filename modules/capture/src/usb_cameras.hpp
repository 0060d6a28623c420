// SPDX-License-Identifier: BSD-3-Clause
// Depth cameras on the USB bus, as the system sees them: whether OpenNI2 could open them, and if
// not, why. Only sources of this module include it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace lockbox {

/// Where the system shows the USB bus.
struct UsbBus {
  std::filesystem::path devices = "/sys/bus/usb/devices";
  std::filesystem::path nodes = "/dev/bus/usb";
};

struct UsbCamera {
  std::string name;            ///< "PrimeSense or Asus Xtion camera (USB 1d27:0601)"
  std::filesystem::path node;  ///< what is opened to use it
  bool is_allowed = false;     ///< whether this user may read and write the node
  std::string holder;          ///< the kernel's driver that has it; "usbfs": a program; empty: none
  bool needs_driver = false;   ///< whether OpenNI2's own drivers do not know it
};

/// The depth cameras of the families that OpenNI2's udev rules name.
std::vector<UsbCamera> usb_cameras(const UsbBus& bus = {});

/// Why it cannot be opened, and what to do; nothing if the system does not stand in the way.
std::optional<std::string> obstacle(const UsbCamera& camera);

/// Why OpenNI2 sees no camera at all, as far as the bus tells, and what to do.
std::string why_no_camera(const std::vector<UsbCamera>& cameras);

}  // namespace lockbox
