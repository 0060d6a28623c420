// SPDX-License-Identifier: BSD-3-Clause
#include "openni_device.hpp"

#include <cstdlib>
#include <string_view>
#include <tuple>

#include "lockbox/core/error.hpp"
#include "openni_session.hpp"

namespace lockbox {
namespace {

/// Recordings that were opened in this process stay in OpenNI2's list of devices, under this name.
bool is_live(const openni::DeviceInfo& info) {
  return std::string_view(info.getName()) != "oni File";
}

std::string first_device() {
  openni::Array<openni::DeviceInfo> devices;
  openni::OpenNI::enumerateDevices(&devices);
  for (int i = 0; i < devices.getSize(); ++i) {
    if (is_live(devices[i])) {
      return devices[i].getUri();
    }
  }
  throw DeviceError(
      "no OpenNI2 device is connected; check the cable and the permissions of the USB device, or "
      "name a recording");
}

std::string list_of_devices() {
  openni::Array<openni::DeviceInfo> devices;
  openni::OpenNI::enumerateDevices(&devices);
  std::string list;
  for (int i = 0; i < devices.getSize(); ++i) {
    if (is_live(devices[i])) {
      list += std::string(list.empty() ? "" : ", ") + devices[i].getUri();
    }
  }
  return list.empty() ? "none" : list;
}

bool is_depth_format(openni::PixelFormat format) {
  return format == openni::PIXEL_FORMAT_DEPTH_1_MM || format == openni::PIXEL_FORMAT_DEPTH_100_UM;
}

/// Smaller is better.
auto rank(const openni::VideoMode& mode) {
  return std::make_tuple(mode.getPixelFormat() != openni::PIXEL_FORMAT_DEPTH_1_MM,
                         std::abs(mode.getResolutionX() - 640),
                         std::abs(mode.getResolutionY() - 480), std::abs(mode.getFps() - 30));
}

/// Chosen explicitly: the default of a device may be any unit.
void choose_mode(const std::string& name, openni::VideoStream& depth) {
  const openni::Array<openni::VideoMode>& modes = depth.getSensorInfo().getSupportedVideoModes();
  const openni::VideoMode* best = nullptr;
  for (int i = 0; i < modes.getSize(); ++i) {
    if (is_depth_format(modes[i].getPixelFormat()) &&
        (best == nullptr || rank(modes[i]) < rank(*best))) {
      best = &modes[i];
    }
  }
  if (best == nullptr) {
    throw DeviceError(name + ": the device offers no depth images in 1 mm or 0.1 mm");
  }
  if (depth.setVideoMode(*best) != openni::STATUS_OK) {
    throw DeviceError(name + ": the depth mode cannot be set: " + openni_error());
  }
}

}  // namespace

void open_depth(const std::string& uri, openni::Device& device, openni::VideoStream& depth) {
  require_openni();
  const std::string name = uri.empty() ? first_device() : uri;
  if (device.open(name.c_str()) != openni::STATUS_OK) {
    throw DeviceError(name + ": no such OpenNI2 device, or it cannot be opened (connected: " +
                      list_of_devices() + "): " + openni_error());
  }
  if (depth.create(device, openni::SENSOR_DEPTH) != openni::STATUS_OK) {
    throw DeviceError(name + ": the device has no depth stream: " + openni_error());
  }
  choose_mode(name, depth);
  depth.setMirroringEnabled(false);
}

UnplugWatch::UnplugWatch(const openni::Device& device) : uri_(device.getDeviceInfo().getUri()) {
  openni::OpenNI::addDeviceDisconnectedListener(this);
}

UnplugWatch::~UnplugWatch() {
  openni::OpenNI::removeDeviceDisconnectedListener(this);
}

void UnplugWatch::onDeviceDisconnected(const openni::DeviceInfo* info) {
  if (uri_ == info->getUri()) {
    unplugged_ = true;
  }
}

}  // namespace lockbox
