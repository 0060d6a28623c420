// SPDX-License-Identifier: BSD-3-Clause
// A virtual camera whose every pixel follows from the frame's number.
#pragma once

#include <chrono>
#include <cmath>
#include <cstdint>

#include "synthetic_frames.hpp"
#include "virtual_camera.hpp"

namespace lockbox {

/// Delivers synthetic frames.
class SyntheticCamera : public VirtualCamera {
 public:
  explicit SyntheticCamera(std::chrono::milliseconds period)
      : VirtualCamera([](std::uint64_t number) { return synthetic_frame(number); },
                      static_cast<int>(1000 / period.count())) {}
};

/// The number of a synthetic frame, by its stamp.
inline std::uint64_t number_of(const DepthFrame& frame) {
  return static_cast<std::uint64_t>(std::llround(frame.stamp / 0.033333));
}

}  // namespace lockbox
