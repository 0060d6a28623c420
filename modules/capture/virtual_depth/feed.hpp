// SPDX-License-Identifier: BSD-3-Clause
// The thread of the virtual device that takes frames from the producer.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <span>
#include <thread>
#include <vector>

#include "connection.hpp"

namespace lockbox::virtual_depth {

/// What a stream makes of a depth image.
class Listener {
 public:
  virtual ~Listener() = default;

  /// Called from the feed's thread.
  virtual void take(std::span<const std::uint16_t> depth, std::uint64_t timestamp) = 0;
};

/// Hands each frame, the moment it arrives, to all streams that are started.
class Feed {
 public:
  /// on_end is called, from the feed's thread, when the producer is gone.
  Feed(Connection& connection, std::function<void()> on_end);
  ~Feed();
  Feed(const Feed&) = delete;
  Feed& operator=(const Feed&) = delete;

  Connection& connection() { return connection_; }

  /// No more than so many frames are taken in all.
  void set_limit(int frames) { limit_ = frames; }

  void add(Listener& listener);

  /// The listener is called no more when this returns.
  void remove(Listener& listener);

 private:
  void run();
  bool hand_on_next();

  Connection& connection_;
  std::function<void()> on_end_;
  std::atomic<int> limit_;
  int taken_ = 0;  ///< frames
  std::vector<std::uint16_t> depth_;
  std::mutex mutex_;  ///< of the listeners
  std::vector<Listener*> listeners_;
  std::atomic<bool> running_{false};
  std::thread thread_;
};

}  // namespace lockbox::virtual_depth
