// SPDX-License-Identifier: BSD-3-Clause
#include "usb_cameras.hpp"

#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iomanip>
#include <sstream>

namespace lockbox {
namespace {

constexpr auto kRules = "/lib/udev/rules.d/60-libopenni2-0.rules";
constexpr int kPrimeSense = 0x1d27;                 // all its devices are depth cameras
constexpr int kMicrosoft = 0x045e;                  // most of its devices are not:
constexpr int kKinectCameras[] = {0x02ae, 0x02bf};  // of the first Kinect

std::string first_word(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string word;
  stream >> word;
  return word;
}

/// The number that a file of sysfs holds, -1 if there is none.
int number_in(const std::filesystem::path& file, int base) {
  const std::string word = first_word(file);
  int number = -1;
  std::from_chars(word.data(), word.data() + word.size(), number, base);
  return number;
}

bool is_kinect(int vendor, int product) {
  return vendor == kMicrosoft &&
         std::count(std::begin(kKinectCameras), std::end(kKinectCameras), product) > 0;
}

std::string three_digits(int number) {
  std::ostringstream text;
  text << std::setw(3) << std::setfill('0') << number;
  return text.str();
}

/// The driver of the device's first interface that has one. Interfaces are folders `1-2:1.0`.
std::string holder_of(const std::filesystem::path& device) {
  const std::string prefix = device.filename().string() + ':';
  std::error_code missing;
  for (const auto& entry : std::filesystem::directory_iterator(device, missing)) {
    if (!entry.path().filename().string().starts_with(prefix)) continue;
    const auto driver = std::filesystem::read_symlink(entry.path() / "driver", missing);
    if (!missing) return driver.filename().string();
  }
  return {};
}

std::optional<UsbCamera> camera_at(const std::filesystem::path& device, const UsbBus& bus) {
  constexpr int kHexadecimal = 16;
  constexpr int kDecimal = 10;
  const int vendor = number_in(device / "idVendor", kHexadecimal);
  const int product = number_in(device / "idProduct", kHexadecimal);
  UsbCamera camera;
  camera.needs_driver = is_kinect(vendor, product);
  if (vendor != kPrimeSense && !camera.needs_driver) return std::nullopt;
  camera.name =
      std::string(camera.needs_driver ? "first Kinect" : "PrimeSense or Asus Xtion camera") +
      " (USB " + first_word(device / "idVendor") + ':' + first_word(device / "idProduct") + ')';
  camera.node = bus.nodes / three_digits(number_in(device / "busnum", kDecimal)) /
                three_digits(number_in(device / "devnum", kDecimal));
  camera.is_allowed = ::access(camera.node.c_str(), R_OK | W_OK) == 0;
  camera.holder = holder_of(device);
  return camera;
}

}  // namespace

std::vector<UsbCamera> usb_cameras(const UsbBus& bus) {
  std::vector<UsbCamera> cameras;
  std::error_code no_bus;
  for (const auto& entry : std::filesystem::directory_iterator(bus.devices, no_bus)) {
    if (auto camera = camera_at(entry.path(), bus)) cameras.push_back(std::move(*camera));
  }
  std::sort(cameras.begin(), cameras.end(),
            [](const UsbCamera& a, const UsbCamera& b) { return a.node < b.node; });
  return cameras;
}

std::optional<std::string> obstacle(const UsbCamera& camera) {
  const std::string who = "the " + camera.name;
  if (!camera.is_allowed) {
    return who + " is plugged in, but you may not open " + camera.node.string() +
           ": the udev rule that allows it is missing, or came later than the camera; install "
           "libopenni2-0 (it brings " +
           kRules + "), then plug the camera in again";
  }
  if (camera.holder == "usbfs") return who + " is in use by another program; end that one";
  if (!camera.holder.empty()) {
    return who + " is taken by the kernel's driver " + camera.holder +
           "; as root: modprobe --remove " + camera.holder;
  }
  return std::nullopt;
}

std::string why_no_camera(const std::vector<UsbCamera>& cameras) {
  if (cameras.empty()) {
    return "no depth camera that OpenNI2 knows is on the USB bus; check the cable and the camera's "
           "power, and whether this machine (or container) is given the USB device";
  }
  std::string text;
  for (const auto& camera : cameras) {
    text += text.empty() ? "" : "; ";
    if (const auto reason = obstacle(camera)) {
      text += *reason;
    } else if (camera.needs_driver) {
      text += "the " + camera.name +
              " is plugged in, but OpenNI2's own drivers do not know it; it needs one of its own";
    } else {
      text += "the " + camera.name +
              " is plugged in and may be opened, but no driver has found it; plug it in again, "
              "at another port without a hub";
    }
  }
  return text;
}

}  // namespace lockbox
