// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lockbox/core/depth_frame.hpp"
#include "lockbox/core/error.hpp"

namespace lockbox {

/// Throws InputError if the camera sees nothing, or an image of that many pixels is not its.
inline void check_image(const PinholeCamera& camera, std::size_t pixels) {
  if (camera.width <= 0 || camera.height <= 0 || !(camera.fx > 0.0) || !(camera.fy > 0.0)) {
    throw InputError("depth frame", "the camera has no size or no focal length");
  }
  if (pixels != static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height)) {
    throw InputError("depth frame", "the image does not have the size that the camera states");
  }
}

/// Throws InputError if camera and depth do not fit together.
inline void check_frame(const DepthFrame& frame) {
  check_image(frame.camera, frame.depth.size());
}

}  // namespace lockbox
