// SPDX-License-Identifier: BSD-3-Clause
// The virtual device driver: OpenNI2 loads this library from its folder of drivers.
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <string>
#include <vector>

#include "return_watch.hpp"
#include "stream.hpp"

namespace lockbox::virtual_depth {
namespace {

OniDeviceInfo device_info(const std::string& uri) {
  OniDeviceInfo info{};
  std::snprintf(info.uri, sizeof(info.uri), "%s", uri.c_str());
  std::snprintf(info.vendor, sizeof(info.vendor), "lockbox");
  std::snprintf(info.name, sizeof(info.name), "Virtual depth camera");
  return info;
}

class Device : public oni::driver::DeviceBase {
 public:
  Device(const std::string& uri, const std::function<void()>& on_end)
      : connection_(uri), feed_(connection_, on_end) {
    for (std::size_t i = 0; i < kSensors.size(); ++i) {
      for (const auto& mode : connection_.modes()) {
        modes_[i].push_back(video_mode_of(kSensors[i], mode));
      }
      sensors_[i] = {kSensors[i], static_cast<int>(modes_[i].size()), modes_[i].data()};
    }
  }

  const Connection& connection() const { return connection_; }

  OniStatus getSensorInfoList(OniSensorInfo** sensors, int* count) override {
    *sensors = sensors_.data();
    *count = sensor_count();
    return ONI_STATUS_OK;
  }

  oni::driver::StreamBase* createStream(OniSensorType type) override {
    const auto end = kSensors.begin() + sensor_count();
    const bool is_offered = std::find(kSensors.begin(), end, type) != end;
    return is_offered ? new Stream(type, feed_) : nullptr;
  }

  void destroyStream(oni::driver::StreamBase* stream) override { delete stream; }

  OniStatus getProperty(int id, void* data, int* size) override {
    const int registration = ONI_IMAGE_REGISTRATION_OFF;
    if (id != ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION ||
        *size < static_cast<int>(sizeof(registration))) {
      return ONI_STATUS_NOT_SUPPORTED;
    }
    std::memcpy(data, &registration, sizeof(registration));
    *size = static_cast<int>(sizeof(registration));
    return ONI_STATUS_OK;
  }

  OniBool isPropertySupported(int id) override {
    return id == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION ? TRUE : FALSE;
  }

 private:
  static constexpr std::array kSensors = {ONI_SENSOR_DEPTH, ONI_SENSOR_COLOR, ONI_SENSOR_IR};

  /// Pictures are made of depths of one size: a camera that offers several has depth only.
  int sensor_count() const {
    return connection_.modes().size() > 1 ? 1 : static_cast<int>(kSensors.size());
  }

  Connection connection_;
  Feed feed_;
  std::array<std::vector<OniVideoMode>, kSensors.size()> modes_;
  std::array<OniSensorInfo, kSensors.size()> sensors_{};
};

}  // namespace

class Driver : public oni::driver::DriverBase {
 public:
  explicit Driver(OniDriverServices* services) : DriverBase(services) {}

  OniStatus initialize(oni::driver::DeviceConnectedCallback connected,
                       oni::driver::DeviceDisconnectedCallback disconnected,
                       oni::driver::DeviceStateChangedCallback changed, void* cookie) override {
    DriverBase::initialize(connected, disconnected, changed, cookie);
    const char* const list = std::getenv(kVirtualDepthVariable);
    std::istringstream paths(list == nullptr ? "" : list);
    for (std::string path; std::getline(paths, path, ':');) {
      tryDevice((kVirtualDepthPrefix + path).c_str());
    }
    return ONI_STATUS_OK;
  }

  OniStatus tryDevice(const char* uri) override {
    if (std::strncmp(uri, kVirtualDepthPrefix, sizeof(kVirtualDepthPrefix) - 1) != 0) {
      return ONI_STATUS_ERROR;
    }
    announce(uri);
    return ONI_STATUS_OK;
  }

  oni::driver::DeviceBase* deviceOpen(const char* uri, const char* /*mode*/) override {
    const std::string name(uri);
    auto* const device = new Device(name, [this, name] {
      const OniDeviceInfo info = device_info(name);
      deviceDisconnected(&info);
      returns_.await(name);  // OpenNI2 opens it again only if it is told that it is back
    });
    if (!device->connection().is_open()) {
      getServices().errorLoggerAppend("%s", device->connection().error().c_str());
      delete device;
      return nullptr;
    }
    return device;
  }

  void deviceClose(oni::driver::DeviceBase* device) override { delete device; }

  void shutdown() override {}

 private:
  void announce(const std::string& uri) {
    const OniDeviceInfo info = device_info(uri);
    deviceConnected(&info);
  }

  ReturnWatch returns_{[this](const std::string& uri) { announce(uri); }};
};

}  // namespace lockbox::virtual_depth

using lockbox::virtual_depth::Driver;
ONI_EXPORT_DRIVER(Driver)
