// SPDX-License-Identifier: BSD-3-Clause
// Images that are shown again and again tell nothing new, for their errors are the same.
#pragma once

#include <cstdint>
#include <vector>

#include "lockbox/core/depth_frame.hpp"
#include "lockbox/core/pinhole_camera.hpp"

namespace lockbox {

/// Counts how often in a row the same image was shown.
class RepeatedImage {
 public:
  /// Shows the next frame. Returns whether it is the last image again, and has been that often
  /// enough for what was found in it to rest. is_found: whether the object was found in it; only
  /// repeats since then count.
  bool shows_nothing_new(const DepthFrame& frame, bool is_found);

 private:
  std::vector<std::uint16_t> depth_;  ///< the image that was shown last
  PinholeCamera camera_;
  float unit_ = 0.0F;
  int repeats_ = 0;  ///< of that image, in a row, since the object was found in it
};

}  // namespace lockbox
