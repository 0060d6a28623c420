// SPDX-License-Identifier: BSD-3-Clause
#include "live_connection.hpp"

#include <algorithm>
#include <string_view>

#include "lockbox/core/error.hpp"
#include "openni_session.hpp"

namespace lockbox {
namespace {

const openni::Device& opened(const std::string& uri, const std::optional<WantedMode>& mode,
                             openni::Device& device, openni::VideoStream& depth) {
  open_depth(uri, mode, device, depth);
  return device;
}

bool is_same_kind(const openni::DeviceInfo& one, const openni::DeviceInfo& other) {
  return std::string_view(one.getVendor()) == other.getVendor() &&
         std::string_view(one.getName()) == other.getName() &&
         one.getUsbVendorId() == other.getUsbVendorId() &&
         one.getUsbProductId() == other.getUsbProductId();
}

}  // namespace

LiveConnection::LiveConnection(const std::string& uri, const std::optional<WantedMode>& mode)
    : unplug_watch_(opened(uri, mode, device_, depth_)),
      is_mirrored_(depth_.getMirroringEnabled()) {}

LiveConnection::~LiveConnection() {
  depth_.stop();
  depth_.destroy();
  device_.close();
}

void LiveConnection::start() {
  if (depth_.start() != openni::STATUS_OK) {
    throw DeviceError(std::string(info().getUri()) +
                      ": the device does not start: " + openni_error());
  }
}

ReturnOfDevice::ReturnOfDevice(const openni::DeviceInfo& device) : device_(device) {
  for (const auto& info : live_devices()) others_.emplace_back(info.getUri());
}

std::vector<std::string> ReturnOfDevice::candidates() const {
  std::vector<std::string> uris = {device_.getUri()};
  for (const auto& info : live_devices()) {
    const std::string uri = info.getUri();
    const bool was_there = std::find(others_.begin(), others_.end(), uri) != others_.end();
    if (!was_there && is_same_kind(info, device_)) uris.push_back(uri);
  }
  return uris;
}

}  // namespace lockbox
