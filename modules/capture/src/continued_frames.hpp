// SPDX-License-Identifier: BSD-3-Clause
// Numbers and stamps of a live device's frames, which go on when it was away and counts anew.
// Only sources of this module include it.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "lockbox/core/depth_frame.hpp"

namespace lockbox {

class ContinuedFrames {
 public:
  using Clock = std::chrono::steady_clock;

  /// The device has been opened again: its next frame is the next one of all.
  void reopen() { first_index_.reset(); }

  /// Numbers the frame, from 0, with gaps where the device has counted frames that were not taken.
  /// Stamps stay as they are; but where the device's clock began anew, they go on by the time that
  /// passed between arrivals.
  void add(int device_index, Clock::time_point arrival, DepthFrame& frame);

  /// Frames that were not taken while the device was there.
  std::size_t dropped() const { return dropped_; }

 private:
  struct Added {
    std::uint64_t index;
    double stamp;
    Clock::time_point arrival;
  };

  void begin(int device_index, Clock::time_point arrival, double stamp);

  std::optional<int> first_index_;  ///< since it was opened, as the device counts
  std::uint64_t begin_ = 0;         ///< that frame's number
  double shift_ = 0.0;              ///< seconds, of stamps since then
  std::optional<Added> last_;
  std::size_t dropped_ = 0;
};

}  // namespace lockbox
