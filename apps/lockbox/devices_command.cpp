// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <iomanip>
#include <iostream>
#include <sstream>

#include "commands.hpp"
#include "lockbox/capture/depth_mode.hpp"
#include "lockbox/capture/device_list.hpp"
#include "lockbox/core/error.hpp"

namespace lockbox::app {
namespace {

constexpr std::string_view kLive = "openni2:";

constexpr auto kDevicesStatusHelp =
    "Here 0 means that there is a device, and that depth of all that are listed opens; 4 that "
    "there "
    "is none, or that one does not open";

/// People paste sources.
std::string uri_of(const std::string& name) {
  return name.starts_with(kLive) ? name.substr(kLive.size()) : name;
}

/// "1d27:0601", as lsusb writes it.
std::string usb_id(const ListedDevice& device) {
  std::ostringstream text;
  text << std::hex << std::setfill('0') << std::setw(4) << device.usb_vendor << ':' << std::setw(4)
       << device.usb_product;
  return text.str();
}

void print(const ListedDevice& device) {
  std::cout << kLive << device.uri << '\n';
  if (!device.name.empty()) {
    std::cout << "  device: " << device.vendor << ", " << device.name;
    if (device.usb_vendor != 0) std::cout << ", USB " << usb_id(device);
    std::cout << '\n';
  }
  if (device.problem) {
    std::cout << "  depth: does not open: " << *device.problem << '\n';
    return;
  }
  std::cout << "  depth: opens\n";
  for (const auto& mode : device.modes) {
    std::cout << "  mode: " << to_string(mode) << (mode == device.chosen ? " (taken)" : "") << '\n';
  }
  if (device.camera) {
    std::cout << std::fixed << std::setprecision(1) << "  focal length: " << device.camera->fx
              << ", " << device.camera->fy << " pixels\n";
  } else {
    std::cout << "  focal length: not told by the device; give --camera-info to other commands\n";
  }
}

class DevicesCommand : public Command {
 public:
  void add_options(CLI::App& options) override {
    options.footer(std::string(options.get_footer()) + "\n\n" + kDevicesStatusHelp);
    options
        .add_option("--uri", uris_,
                    "Also look at this device, which OpenNI2 may not find by itself (repeatable)")
        ->type_name("URI")
        ->default_str("");
  }

  ExitStatus run() override {
    std::vector<std::string> uris;
    for (const auto& name : uris_) uris.push_back(uri_of(name));
    const auto devices = list_devices(uris);
    if (devices.empty()) throw DeviceError(why_no_device());
    for (const auto& device : devices) print(device);
    const bool all_open = std::none_of(devices.begin(), devices.end(),
                                       [](const auto& device) { return device.problem; });
    return all_open ? ExitStatus::done : ExitStatus::device_failed;
  }

 private:
  std::vector<std::string> uris_;
};

}  // namespace

std::unique_ptr<Command> make_devices_command() {
  return std::make_unique<DevicesCommand>();
}

}  // namespace lockbox::app
