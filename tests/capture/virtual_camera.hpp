// SPDX-License-Identifier: BSD-3-Clause
// A depth camera that can be unplugged, plugged in again and stalled: a device of the real OpenNI2
// runtime, through the virtual device driver.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "lockbox/capture/virtual_depth.hpp"
#include "lockbox/core/error.hpp"
#include "temporary_folder.hpp"

namespace lockbox {

class VirtualCamera {
 public:
  /// frame: what it sees, by the number of frames that were sent since it exists.
  VirtualCamera(const std::function<DepthFrame(std::uint64_t)>& frame, int frames_per_second,
                float metres_per_unit = 0.001F)
      : frame_([frame](std::uint64_t number, std::size_t) { return frame(number); }),
        modes_{{frame(0).camera, frames_per_second, metres_per_unit}} {
    plug_in();
  }

  /// The same in one of several modes, by its index.
  VirtualCamera(std::function<DepthFrame(std::uint64_t, std::size_t)> frame,
                std::vector<VirtualMode> modes)
      : frame_(std::move(frame)), modes_(std::move(modes)) {
    plug_in();
  }
  ~VirtualCamera() { unplug(); }
  VirtualCamera(const VirtualCamera&) = delete;
  VirtualCamera& operator=(const VirtualCamera&) = delete;

  std::string socket() const { return folder_ / "camera"; }
  std::string uri() const { return "virtual-depth:" + socket(); }

  void plug_in() {
    is_plugged_ = true;
    server_ = std::make_unique<VirtualDepthServer>(socket());
    thread_ = std::thread([this] { serve(); });
  }

  void unplug() {
    is_plugged_ = false;
    if (!server_) return;
    server_->close();
    thread_.join();
    server_.reset();
  }

  void stall() { is_stalled_ = true; }
  void go_on() { is_stalled_ = false; }

  /// Frames on their way to the user of the device. Those that it was too busy for, or came before
  /// it was started, are not among them, but for two or three that the socket holds.
  std::uint64_t taken() const { return taken_; }

 private:
  void serve() {
    while (is_plugged_) {
      try {
        deliver(modes_.size() > 1 ? server_->accept(modes_)
                                  : server_->accept(modes_[0].camera, modes_[0].frames_per_second,
                                                    modes_[0].metres_per_unit));
      } catch (const DeviceError&) {
        // Its user has closed it, or it is unplugged.
      }
    }
  }

  void deliver(VirtualDepthSender sender) {
    auto next = std::chrono::steady_clock::now();
    while (is_plugged_) {
      const auto mode = sender.mode();
      if (mode && !is_stalled_ && sender.try_send(frame_(sent_++, *mode))) ++taken_;
      next += std::chrono::microseconds(1'000'000 / modes_[mode.value_or(0)].frames_per_second);
      std::this_thread::sleep_until(next);
    }
  }

  TemporaryFolder folder_;
  std::function<DepthFrame(std::uint64_t, std::size_t)> frame_;
  std::vector<VirtualMode> modes_;
  std::atomic<bool> is_plugged_{false};
  std::atomic<bool> is_stalled_{false};
  std::uint64_t sent_ = 0;  ///< whether they were taken or not; of the thread
  std::atomic<std::uint64_t> taken_{0};
  std::unique_ptr<VirtualDepthServer> server_;
  std::thread thread_;
};

}  // namespace lockbox
