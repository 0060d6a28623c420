// SPDX-License-Identifier: BSD-3-Clause
#include "ticker.hpp"

#include <utility>

namespace lockbox::app {

Ticker::Ticker(std::chrono::milliseconds period, std::function<void()> tick)
    : tick_(std::move(tick)), thread_([this, period] { run(period); }) {}

Ticker::~Ticker() {
  {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
  }
  over_.notify_one();
  thread_.join();
}

void Ticker::run(std::chrono::milliseconds period) {
  std::unique_lock lock(mutex_);
  while (!over_.wait_for(lock, period, [this] { return is_over_; })) tick_();
}

}  // namespace lockbox::app
