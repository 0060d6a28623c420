// SPDX-License-Identifier: BSD-3-Clause
#include "feed.hpp"

#include <algorithm>
#include <chrono>
#include <limits>

namespace lockbox::virtual_depth {
namespace {

constexpr int kSlice = 20;  // milliseconds between looks at whether to stop

}  // namespace

Feed::Feed(Connection& connection, std::function<void()> on_end)
    : connection_(connection),
      on_end_(std::move(on_end)),
      limit_(connection.header().hold != 0 ? 0 : std::numeric_limits<int>::max()) {}

Feed::~Feed() {
  running_ = false;
  if (thread_.joinable()) {
    thread_.join();
  }
}

void Feed::add(Listener& listener) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    listeners_.push_back(&listener);
  }
  if (!running_) {
    depth_.resize(connection_.frame_bytes() / sizeof(std::uint16_t));
    running_ = true;
    thread_ = std::thread([this] { run(); });
  }
}

void Feed::remove(Listener& listener) {
  bool is_last = false;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_last = std::erase(listeners_, &listener) > 0 && listeners_.empty();
  }
  if (is_last) {
    running_ = false;
    thread_.join();
  }
}

void Feed::run() {
  while (running_) {
    if (taken_ >= limit_) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      continue;
    }
    const Connection::Wait state = connection_.wait(kSlice);
    if (state == Connection::Wait::closed ||
        (state == Connection::Wait::ready && !hand_on_next())) {
      on_end_();
      return;
    }
  }
}

bool Feed::hand_on_next() {
  std::uint64_t timestamp = 0;
  if (!connection_.read_frame(timestamp, depth_.data())) {
    return false;
  }
  ++taken_;
  const std::lock_guard<std::mutex> lock(mutex_);
  for (Listener* const listener : listeners_) {
    listener->take(depth_, timestamp);
  }
  return true;
}

}  // namespace lockbox::virtual_depth
