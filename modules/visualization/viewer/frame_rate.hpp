// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <optional>

namespace lockbox {

/// How many frames a second are drawn.
class FrameRate {
 public:
  /// A frame was drawn. The rate since this was last told, once each second; a picture that stands
  /// still for longer has none.
  std::optional<double> add() {
    if (has_stopped()) start();
    last_ = Clock::now();
    ++drawn_;
    const double seconds = std::chrono::duration<double>(last_ - start_).count();
    if (seconds < 1.0) return std::nullopt;
    const double rate = drawn_ / seconds;
    start();
    return rate;
  }

  /// Whether nothing was drawn for a second.
  bool has_stopped() const { return Clock::now() - last_ > std::chrono::seconds(1); }

 private:
  using Clock = std::chrono::steady_clock;

  void start() {
    start_ = Clock::now();
    drawn_ = 0;
  }

  Clock::time_point start_;
  Clock::time_point last_;
  int drawn_ = 0;
};

}  // namespace lockbox
