// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <chrono>
#include <optional>

namespace lockbox {

/// How many frames a second are drawn.
class FrameRate {
 public:
  using Clock = std::chrono::steady_clock;

  /// A frame was drawn, since then until now. The rate since this was last told, once each second;
  /// a picture that had stood still before has none until it moves for a second, or is drawn for
  /// one.
  std::optional<double> add(Clock::time_point begun) {
    if (begun - last_ > patience()) start(begun);
    last_ = Clock::now();
    last_drawing_ = last_ - begun;
    ++drawn_;
    const double seconds = std::chrono::duration<double>(last_ - start_).count();
    if (seconds < 1.0) return std::nullopt;
    const double rate = drawn_ / seconds;
    start(last_);
    return rate;
  }

  /// Whether nothing was drawn for longer than from one drawing to the next.
  bool has_stopped() const { return Clock::now() - last_ > patience(); }

 private:
  /// A second, or where drawing takes long, twice that: who draws beside other work rests as long
  /// as drawing took.
  Clock::duration patience() const {
    return std::max<Clock::duration>(std::chrono::seconds(1), 2 * last_drawing_);
  }

  void start(Clock::time_point when) {
    start_ = when;
    drawn_ = 0;
  }

  Clock::time_point start_;
  Clock::time_point last_;
  Clock::duration last_drawing_ = Clock::duration::zero();
  int drawn_ = 0;
};

}  // namespace lockbox
