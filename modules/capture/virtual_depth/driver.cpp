// SPDX-License-Identifier: BSD-3-Clause
// The virtual device driver: OpenNI2 loads this library from its folder of drivers.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

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
  Device(const std::string& uri, std::function<void()> on_end)
      : connection_(uri), on_end_(std::move(on_end)) {
    mode_ = video_mode_of(connection_.header());
    sensor_ = {ONI_SENSOR_DEPTH, 1, &mode_};
  }

  const Connection& connection() const { return connection_; }

  OniStatus getSensorInfoList(OniSensorInfo** sensors, int* count) override {
    *sensors = &sensor_;
    *count = 1;
    return ONI_STATUS_OK;
  }

  oni::driver::StreamBase* createStream(OniSensorType type) override {
    return type == ONI_SENSOR_DEPTH ? new Stream(connection_, on_end_) : nullptr;
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
  Connection connection_;
  std::function<void()> on_end_;
  OniVideoMode mode_{};
  OniSensorInfo sensor_{};
};

}  // namespace

class Driver : public oni::driver::DriverBase {
 public:
  explicit Driver(OniDriverServices* services) : DriverBase(services) {}

  OniStatus initialize(oni::driver::DeviceConnectedCallback connected,
                       oni::driver::DeviceDisconnectedCallback disconnected,
                       oni::driver::DeviceStateChangedCallback changed, void* cookie) override {
    DriverBase::initialize(connected, disconnected, changed, cookie);
    if (const char* const path = std::getenv(kVirtualDepthVariable)) {
      tryDevice((std::string(kVirtualDepthPrefix) + path).c_str());
    }
    return ONI_STATUS_OK;
  }

  OniStatus tryDevice(const char* uri) override {
    if (std::strncmp(uri, kVirtualDepthPrefix, sizeof(kVirtualDepthPrefix) - 1) != 0) {
      return ONI_STATUS_ERROR;
    }
    const OniDeviceInfo info = device_info(uri);
    deviceConnected(&info);
    return ONI_STATUS_OK;
  }

  oni::driver::DeviceBase* deviceOpen(const char* uri, const char* /*mode*/) override {
    const std::string name(uri);
    auto* const device = new Device(name, [this, name] {
      const OniDeviceInfo info = device_info(name);
      deviceDisconnected(&info);
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
};

}  // namespace lockbox::virtual_depth

using lockbox::virtual_depth::Driver;
ONI_EXPORT_DRIVER(Driver)
