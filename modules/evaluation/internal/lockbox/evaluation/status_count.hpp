// SPDX-License-Identifier: BSD-3-Clause
// Can the status `tracking` be trusted, and does it say so of what is right?
#pragma once

#include <cstddef>

namespace lockbox {

/// Counts of frames.
struct StatusCount {
  std::size_t tracking = 0;
  std::size_t tracking_but_wrong = 0;  ///< base, or a joint not flagged, beyond its tolerance
  std::size_t right = 0;               ///< within all tolerances
  std::size_t right_but_not_tracking = 0;

  void add(bool is_tracking, bool is_right) {
    tracking += is_tracking ? 1 : 0;
    right += is_right ? 1 : 0;
    tracking_but_wrong += is_tracking && !is_right ? 1 : 0;
    right_but_not_tracking += is_right && !is_tracking ? 1 : 0;
  }

  StatusCount& operator+=(const StatusCount& other) {
    tracking += other.tracking;
    tracking_but_wrong += other.tracking_but_wrong;
    right += other.right;
    right_but_not_tracking += other.right_but_not_tracking;
    return *this;
  }
};

}  // namespace lockbox
