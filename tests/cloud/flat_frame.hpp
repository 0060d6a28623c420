// SPDX-License-Identifier: BSD-3-Clause
// A small camera, and what it measures of a wall.
#pragma once

#include <cstddef>
#include <cstdint>

#include "lockbox/core/depth_frame.hpp"

namespace lockbox {

inline const PinholeCamera kSmallCamera{100, 70, 80.0, 90.0, 49.0, 34.5};

inline std::size_t pixel_at(int u, int v) {
  return static_cast<std::size_t>(v) * static_cast<std::size_t>(kSmallCamera.width) +
         static_cast<std::size_t>(u);
}

inline DepthFrame flat_frame(std::uint16_t millimetres) {
  DepthFrame frame;
  frame.camera = kSmallCamera;
  frame.depth.assign(pixel_at(0, kSmallCamera.height), millimetres);
  return frame;
}

}  // namespace lockbox
