// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/capture/device_list.hpp"

#include <algorithm>

#include "lockbox/core/error.hpp"
#include "openni_device.hpp"
#include "openni_session.hpp"

namespace lockbox {
namespace {

void describe(const openni::DeviceInfo& info, ListedDevice& device) {
  device.vendor = info.getVendor();
  device.name = info.getName();
  device.usb_vendor = info.getUsbVendorId();
  device.usb_product = info.getUsbProductId();
}

void describe(const openni::VideoStream& depth, ListedDevice& device) {
  for (const auto& mode : depth_modes(depth)) device.modes.push_back(mode);
  device.chosen = described(depth.getVideoMode());
  if (const auto angles = field_of_view(depth)) {
    device.camera = camera_of(*angles, device.chosen->width, device.chosen->height);
  }
}

ListedDevice look_at(const std::string& uri) {
  ListedDevice listed;
  listed.uri = uri;
  for (const auto& info : live_devices()) {
    if (uri == info.getUri()) describe(info, listed);
  }
  try {
    openni::Device device;
    openni::VideoStream depth;
    open_depth(uri, std::nullopt, device, depth);
    describe(device.getDeviceInfo(), listed);
    describe(depth, listed);
  } catch (const DeviceError& error) {
    listed.problem = error.what();
  }
  return listed;
}

}  // namespace

std::vector<ListedDevice> list_devices(const std::vector<std::string>& uris) {
  require_openni();
  std::vector<std::string> all;
  for (const auto& info : live_devices()) all.emplace_back(info.getUri());
  for (const auto& uri : uris) {
    if (std::find(all.begin(), all.end(), uri) == all.end()) all.push_back(uri);
  }
  std::vector<ListedDevice> devices;
  devices.reserve(all.size());
  for (const auto& uri : all) devices.push_back(look_at(uri));
  return devices;
}

std::string why_no_device() {
  require_openni();
  return absence_text();
}

}  // namespace lockbox
