// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/capture/virtual_depth.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <utility>

#include "lockbox/capture/virtual_depth_protocol.hpp"
#include "lockbox/core/component.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/core/number_text.hpp"
#include "lockbox/core/readable_text.hpp"
#include "openni_session.hpp"

namespace lockbox {
namespace {

constexpr auto kHeldByFolders =
    "; a depth folder can (docs/recordings.md): write into one, or leave these frames where they "
    "are, every command takes them from there, too";

constexpr char kCamera[] = "virtual depth camera";  // where what was asked for is impossible
constexpr auto kClosed = "the virtual depth camera was closed by its user";

std::uint32_t unit_of(float metres_per_unit, const std::string& where) {
  if (metres_per_unit == 0.001F) {
    return 1000;
  }
  if (metres_per_unit == 0.0001F) {
    return 100;
  }
  throw InputError(where, "an .oni file holds depths in units of 1 mm and 0.1 mm, not of " +
                              number_text(std::round(1e9 * metres_per_unit) / 1e6) + " mm" +
                              with_documents(kHeldByFolders, &kCamera));
}

/// Pixels by which a principal point may be beside the middle, and is taken for it: of clouds whose
/// numbers are rounded it is recovered that well. It moves what is 5 m away by 10 um, twice as much
/// by 20 um, far less than any camera tells.
constexpr double kBesideTheMiddle = 1e-3;

std::string pixel_text(double coordinate) {
  constexpr int kDigits = 7;
  return readable_number(coordinate, kDigits);
}

VirtualDepthHeader header_of(const VirtualMode& mode, const std::string& where) {
  const PinholeCamera& camera = mode.camera;
  if (std::abs(camera.cx - 0.5 * (camera.width - 1)) > kBesideTheMiddle ||
      std::abs(camera.cy - 0.5 * (camera.height - 1)) > kBesideTheMiddle) {
    throw InputError(where, "the camera's principal point (" + pixel_text(camera.cx) + ", " +
                                pixel_text(camera.cy) +
                                ") is not the middle of the image, and an .oni file cannot tell "
                                "of another one" +
                                kHeldByFolders);
  }
  VirtualDepthHeader header;
  header.width = static_cast<std::uint32_t>(camera.width);
  header.height = static_cast<std::uint32_t>(camera.height);
  header.frames_per_second = static_cast<std::uint32_t>(mode.frames_per_second);
  header.horizontal_field_of_view = field_of_view(camera.width, camera.fx);
  header.vertical_field_of_view = field_of_view(camera.height, camera.fy);
  header.unit = unit_of(mode.metres_per_unit, where);
  return header;
}

/// The header, and what says the other modes.
std::vector<char> beginning_of(const std::vector<VirtualMode>& modes) {
  VirtualDepthHeader header = header_of(modes.front(), kCamera);
  header.version = 2;
  const auto more = static_cast<std::uint32_t>(modes.size() - 1);
  std::vector<char> bytes;
  const auto add = [&bytes](const auto& value) {
    const auto* const from = reinterpret_cast<const char*>(&value);
    bytes.insert(bytes.end(), from, from + sizeof(value));
  };
  add(header);
  add(more);
  for (std::size_t i = 1; i < modes.size(); ++i) {
    const VirtualDepthHeader other = header_of(modes[i], kCamera);
    if (other.horizontal_field_of_view != header.horizontal_field_of_view ||
        other.vertical_field_of_view != header.vertical_field_of_view) {
      throw InputError(kCamera, "its modes have different fields of view, and a device has one");
    }
    add(VirtualDepthMode{other.width, other.height, other.frames_per_second, other.unit});
  }
  return bytes;
}

}  // namespace

VirtualDepthSender::VirtualDepthSender(int socket, const PinholeCamera& camera,
                                       int frames_per_second, float metres_per_unit,
                                       const std::string& recorded)
    : socket_(socket), modes_{{camera, frames_per_second, metres_per_unit}}, mode_(0) {
  try {
    VirtualDepthHeader header = header_of(modes_.front(), recorded.empty() ? kCamera : recorded);
    header.hold = recorded.empty() ? 0 : 1;
    send_bytes(&header, sizeof(header));
  } catch (...) {
    ::close(socket_);
    throw;
  }
}

VirtualDepthSender::VirtualDepthSender(int socket, std::vector<VirtualMode> modes)
    : socket_(socket), modes_(std::move(modes)) {
  try {
    const auto beginning = beginning_of(modes_);
    send_bytes(beginning.data(), beginning.size());
  } catch (...) {
    ::close(socket_);
    throw;
  }
}

VirtualDepthSender::~VirtualDepthSender() {
  if (socket_ >= 0) {
    ::shutdown(socket_, SHUT_RDWR);  // seen at the other end even if a child process has a copy
    ::close(socket_);
  }
}

VirtualDepthSender::VirtualDepthSender(VirtualDepthSender&& other) noexcept
    : socket_(std::exchange(other.socket_, -1)),
      modes_(std::move(other.modes_)),
      mode_(other.mode_) {}

std::optional<std::size_t> VirtualDepthSender::mode() {
  pollfd descriptor{socket_, POLLIN, 0};
  if (mode_ || ::poll(&descriptor, 1, 0) <= 0) return mode_;
  std::uint32_t number = 0;
  if (::recv(socket_, &number, sizeof(number), MSG_WAITALL) != ssize_t{sizeof(number)} ||
      number >= modes_.size()) {
    throw DeviceError(kClosed);
  }
  mode_ = number;
  return mode_;
}

void VirtualDepthSender::send(const DepthFrame& frame) {
  if (!mode() || !(frame.camera == modes_[*mode()].camera)) {
    throw InputError("frame " + std::to_string(frame.index),
                     "has another camera than the mode of the device");
  }
  const auto timestamp = static_cast<std::uint64_t>(std::llround(frame.stamp * 1e6));
  send_bytes(&timestamp, sizeof(timestamp));
  send_bytes(frame.depth.data(), frame.depth.size() * sizeof(std::uint16_t));
}

bool VirtualDepthSender::try_send(const DepthFrame& frame) {
  pollfd descriptor{socket_, POLLOUT, 0};
  if (::poll(&descriptor, 1, 0) <= 0) {
    return false;
  }
  send(frame);
  return true;
}

void VirtualDepthSender::send_bytes(const void* bytes, std::size_t size) {
  const auto* from = static_cast<const char*>(bytes);
  while (size > 0) {
    const ssize_t count = ::send(socket_, from, size, MSG_NOSIGNAL);
    if (count <= 0) {
      throw DeviceError(kClosed);
    }
    from += count;
    size -= static_cast<std::size_t>(count);
  }
}

VirtualDepthServer::VirtualDepthServer(const std::filesystem::path& socket) : path_(socket) {
  sockaddr_un name{};
  name.sun_family = AF_UNIX;
  const std::string path = socket.string();
  if (path.size() >= sizeof(name.sun_path)) {
    throw DeviceError(path + ": the path of a socket may have at most 107 characters");
  }
  std::memcpy(name.sun_path, path.c_str(), path.size());
  ::unlink(path.c_str());
  socket_ = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (::bind(socket_, reinterpret_cast<const sockaddr*>(&name), sizeof(name)) != 0 ||
      ::listen(socket_, 1) != 0) {
    const std::string reason = std::strerror(errno);
    ::close(socket_);
    throw DeviceError(path + ": a socket cannot be created there (" + reason + ")");
  }
}

VirtualDepthServer::~VirtualDepthServer() {
  ::close(socket_);
  ::unlink(path_.c_str());
}

void VirtualDepthServer::close() {
  ::shutdown(socket_, SHUT_RDWR);
}

std::string VirtualDepthServer::uri() const {
  return kVirtualDepthPrefix + path_.string();
}

VirtualDepthSender VirtualDepthServer::accept(const PinholeCamera& camera, int frames_per_second,
                                              float metres_per_unit) {
  return {connected(), camera, frames_per_second, metres_per_unit};
}

VirtualDepthSender VirtualDepthServer::accept(std::vector<VirtualMode> modes) {
  return {connected(), std::move(modes)};
}

int VirtualDepthServer::connected() const {
  const int connection = ::accept4(socket_, nullptr, nullptr, SOCK_CLOEXEC);
  if (connection < 0) {
    throw DeviceError(path_.string() + ": no connection (" + std::strerror(errno) + ")");
  }
  return connection;
}

}  // namespace lockbox
