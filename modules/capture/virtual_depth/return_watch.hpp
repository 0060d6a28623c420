// SPDX-License-Identifier: BSD-3-Clause
// What the USB bus tells drivers of cameras: that one was plugged in again.
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace lockbox::virtual_depth {

/// Looks for the sockets of producers that have gone.
class ReturnWatch {
 public:
  /// on_return is called with the URI, from the watch's thread.
  explicit ReturnWatch(std::function<void(const std::string&)> on_return)
      : on_return_(std::move(on_return)) {}
  ~ReturnWatch();
  ReturnWatch(const ReturnWatch&) = delete;
  ReturnWatch& operator=(const ReturnWatch&) = delete;

  /// Watches for this device, until it is there once.
  void await(const std::string& uri);

 private:
  void run();
  std::vector<std::string> take_returned();

  std::function<void(const std::string&)> on_return_;
  std::mutex mutex_;               ///< of both below
  std::vector<std::string> away_;  ///< URIs
  std::thread thread_;
  std::atomic<bool> running_{false};
};

}  // namespace lockbox::virtual_depth
