// SPDX-License-Identifier: BSD-3-Clause
#include "openni_device.hpp"

#include <cstdlib>
#include <string_view>
#include <tuple>

#include "lockbox/capture/depth_mode.hpp"
#include "lockbox/core/error.hpp"
#include "openni_session.hpp"
#include "usb_cameras.hpp"

namespace lockbox {
namespace {

std::string first_device() {
  const auto devices = live_devices();
  if (devices.empty()) throw DeviceError(absence_text());
  return devices.front().getUri();
}

/// Why a device cannot be opened whose name is right.
std::string hint() {
  for (const auto& camera : usb_cameras()) {
    if (const auto reason = obstacle(camera)) return "; " + *reason;
  }
  return "; does another program use it?";
}

std::string why_not_opened(const std::string& name) {
  const std::string error = openni_error();
  std::string list;
  for (const auto& info : live_devices()) {
    if (name == info.getUri()) return name + ": the device cannot be opened: " + error + hint();
    list += std::string(list.empty() ? "" : ", ") + info.getUri();
  }
  return name + ": no such OpenNI2 device, or it cannot be opened (connected: " +
         (list.empty() ? "none" : list) + "): " + error;
}

/// Smaller is better.
auto rank(const openni::VideoMode& mode) {
  return std::make_tuple(mode.getPixelFormat() != openni::PIXEL_FORMAT_DEPTH_1_MM,
                         std::abs(mode.getResolutionX() - 640),
                         std::abs(mode.getResolutionY() - 480), std::abs(mode.getFps() - 30));
}

bool is_wanted(const openni::VideoMode& mode, const std::optional<WantedMode>& wanted) {
  if (!is_depth_format(mode.getPixelFormat())) return false;
  return !wanted ||
         (mode.getResolutionX() == wanted->width && mode.getResolutionY() == wanted->height &&
          mode.getFps() == wanted->frames_per_second &&
          (!wanted->metres_per_unit ||
           described(mode).metres_per_unit == *wanted->metres_per_unit));
}

std::string why_no_mode(const openni::VideoStream& depth, const std::optional<WantedMode>& wanted) {
  std::string list;
  for (const auto& mode : depth_modes(depth)) list += (list.empty() ? "" : " ") + to_string(mode);
  if (list.empty()) return "the device offers no depth images in 1 mm or 0.1 mm";
  return "the device does not offer the mode " + to_string(*wanted) + " (--mode); it offers " +
         list;
}

/// Chosen explicitly: the default of a device may be any unit.
void choose_mode(const std::string& name, const std::optional<WantedMode>& wanted,
                 openni::VideoStream& depth) {
  const openni::Array<openni::VideoMode>& modes = depth.getSensorInfo().getSupportedVideoModes();
  const openni::VideoMode* best = nullptr;
  for (int i = 0; i < modes.getSize(); ++i) {
    if (is_wanted(modes[i], wanted) && (best == nullptr || rank(modes[i]) < rank(*best))) {
      best = &modes[i];
    }
  }
  if (best == nullptr) throw DeviceError(name + ": " + why_no_mode(depth, wanted));
  if (depth.setVideoMode(*best) != openni::STATUS_OK) {
    throw DeviceError(name + ": the depth mode cannot be set: " + openni_error());
  }
}

}  // namespace

bool is_depth_format(openni::PixelFormat format) {
  return format == openni::PIXEL_FORMAT_DEPTH_1_MM || format == openni::PIXEL_FORMAT_DEPTH_100_UM;
}

DepthMode described(const openni::VideoMode& mode) {
  const bool tenths = mode.getPixelFormat() == openni::PIXEL_FORMAT_DEPTH_100_UM;
  return {mode.getResolutionX(), mode.getResolutionY(), mode.getFps(), tenths ? 1e-4 : 1e-3};
}

std::vector<DepthMode> depth_modes(const openni::VideoStream& depth) {
  const auto& offered = depth.getSensorInfo().getSupportedVideoModes();
  std::vector<DepthMode> modes;
  for (int i = 0; i < offered.getSize(); ++i) {
    if (is_depth_format(offered[i].getPixelFormat())) modes.push_back(described(offered[i]));
  }
  return modes;
}

std::vector<openni::DeviceInfo> live_devices() {
  // Recordings that were opened in this process stay in OpenNI2's list, under this name.
  constexpr std::string_view kRecording = "oni File";
  openni::Array<openni::DeviceInfo> devices;
  openni::OpenNI::enumerateDevices(&devices);
  std::vector<openni::DeviceInfo> live;
  for (int i = 0; i < devices.getSize(); ++i) {
    if (devices[i].getName() != kRecording) live.push_back(devices[i]);
  }
  return live;
}

std::string absence_text() {
  return "no OpenNI2 device is connected: " + why_no_camera(usb_cameras()) +
         " (drivers are loaded from " + driver_folder() + ")";
}

void open_depth(const std::string& uri, const std::optional<WantedMode>& wanted,
                openni::Device& device, openni::VideoStream& depth) {
  require_openni();
  const std::string name = uri.empty() ? first_device() : uri;
  if (device.open(name.c_str()) != openni::STATUS_OK) {
    throw DeviceError(why_not_opened(name));
  }
  if (depth.create(device, openni::SENSOR_DEPTH) != openni::STATUS_OK) {
    throw DeviceError(name + ": the device has no depth stream: " + openni_error());
  }
  choose_mode(name, wanted, depth);
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
