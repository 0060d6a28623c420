// SPDX-License-Identifier: BSD-3-Clause
// Depth frames whose every pixel follows from the frame's number.
#pragma once

#include <cstdint>

#include "lockbox/core/depth_frame.hpp"

namespace lockbox {

inline PinholeCamera small_camera() {
  return {160, 120, 143.9539, 143.9539, 79.5, 59.5};
}

inline PinholeCamera tiny_camera() {
  return {32, 24, 30.0, 30.0, 15.5, 11.5};
}

/// A slanted wall with integer-hash noise and holes, in millimetres.
inline DepthFrame synthetic_frame(std::uint64_t number,
                                  const PinholeCamera& camera = small_camera()) {
  DepthFrame frame;
  frame.camera = camera;
  frame.index = number;
  frame.stamp = 0.033333 * static_cast<double>(number);
  frame.depth.reserve(static_cast<std::size_t>(camera.width) *
                      static_cast<std::size_t>(camera.height));
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      std::uint32_t hash = static_cast<std::uint32_t>(number) * 73856093U ^
                           static_cast<std::uint32_t>(u) * 19349663U ^
                           static_cast<std::uint32_t>(v) * 83492791U;
      hash = (hash ^ (hash >> 15)) * 0x2c1b3c6dU;
      hash ^= hash >> 12;
      const bool hole = hash % 50 == 0;
      frame.depth.push_back(
          hole ? std::uint16_t{0}
               : static_cast<std::uint16_t>(1000 + 5 * u + 3 * v + static_cast<int>(hash % 7)));
    }
  }
  return frame;
}

}  // namespace lockbox
