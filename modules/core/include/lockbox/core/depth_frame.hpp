// SPDX-License-Identifier: BSD-3-Clause
// One depth image as a sensor delivers it, with all that is needed to interpret it.
#pragma once

#include <cstdint>
#include <vector>

#include "lockbox/core/pinhole_camera.hpp"

namespace lockbox {

/// One depth image with its camera, unit and time.
struct DepthFrame {
  PinholeCamera camera;  ///< intrinsics, and the size of the image
  /// Depth along the optical axis, row by row, width * height values; 0 means "no measurement".
  std::vector<std::uint16_t> depth;
  float metres_per_unit = 0.001F;  ///< the unit of the depths
  double stamp = 0.0;              ///< seconds
  std::uint64_t index = 0;         ///< number of the frame in its source, from 0

  /// Returns the depth of pixel (u, v) in metres; 0 where nothing was measured.
  float metres(int u, int v) const {
    return static_cast<float>(
               depth[static_cast<std::size_t>(v) * static_cast<std::size_t>(camera.width) +
                     static_cast<std::size_t>(u)]) *
           metres_per_unit;
  }
};

}  // namespace lockbox
