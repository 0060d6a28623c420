// SPDX-License-Identifier: BSD-3-Clause
// Turns any producer of depth frames into a live device of OpenNI2, through the virtual device
// driver (libVirtualDepth.so.0, loaded by OpenNI2 itself).
// virtual_depth_protocol.hpp has what passes between the two.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lockbox/core/depth_frame.hpp"

namespace lockbox {

/// A way in which a virtual camera can deliver frames.
struct VirtualMode {
  PinholeCamera camera;
  int frames_per_second;
  float metres_per_unit;
};

/// The producer's end of a connection.
class VirtualDepthSender {
 public:
  /// Takes over a connected stream socket. Throws InputError if OpenNI2 cannot describe the camera:
  /// the principal point must be the middle of the image, the unit 1 mm or 0.1 mm. With recorded,
  /// the name of what the frames are for or from, for messages, the device delivers nothing until
  /// its user sets kVirtualDepthLimit.
  VirtualDepthSender(int socket, const PinholeCamera& camera, int frames_per_second,
                     float metres_per_unit, const std::string& recorded = {});

  /// Makes a sender for a camera of which the user chooses one of these modes (one at least), all
  /// of the same field of view.
  VirtualDepthSender(int socket, std::vector<VirtualMode> modes);
  ~VirtualDepthSender();
  VirtualDepthSender(VirtualDepthSender&& other) noexcept;
  VirtualDepthSender& operator=(VirtualDepthSender&&) = delete;

  /// The mode that the user has chosen, in which frames are to be sent. Nothing until the device is
  /// started. Throws DeviceError if it was closed.
  std::optional<std::size_t> mode();

  /// Waits until the device has taken the frame: nothing is lost, however slow the other end is.
  /// Throws DeviceError if the device was closed. Stamps must not be negative.
  void send(const DepthFrame& frame);

  /// Drops the frame and returns false if the device is not taking frames now, like a camera.
  bool try_send(const DepthFrame& frame);

 private:
  void send_bytes(const void* bytes, std::size_t size);

  int socket_;
  std::vector<VirtualMode> modes_;
  std::optional<std::size_t> mode_;  ///< nothing: not chosen yet
};

/// Listens on a Unix socket for the driver to open the device.
class VirtualDepthServer {
 public:
  /// Creates the socket; its path may have at most 107 characters. Throws DeviceError.
  explicit VirtualDepthServer(const std::filesystem::path& socket);
  ~VirtualDepthServer();
  VirtualDepthServer(const VirtualDepthServer&) = delete;
  VirtualDepthServer& operator=(const VirtualDepthServer&) = delete;

  std::string uri() const;  ///< for `openni2:<uri>`

  /// Takes no more users: a waiting accept() throws. From any thread.
  void close();

  /// Waits until the device is opened. Throws DeviceError after close().
  VirtualDepthSender accept(const PinholeCamera& camera, int frames_per_second,
                            float metres_per_unit);
  VirtualDepthSender accept(std::vector<VirtualMode> modes);

 private:
  int connected() const;

  std::filesystem::path path_;
  int socket_ = -1;
};

}  // namespace lockbox
