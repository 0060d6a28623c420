// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/tracking/repeated_image.hpp"

namespace lockbox {
namespace {

constexpr int kRepeatsToRest = 4;  // of an image, until what is found in it rests

}  // namespace

bool RepeatedImage::shows_nothing_new(const DepthFrame& frame, bool is_found) {
  if (frame.camera == camera_ && frame.metres_per_unit == unit_ && frame.depth == depth_) {
    repeats_ = is_found ? repeats_ + 1 : 0;
  } else {
    repeats_ = 0;
    depth_ = frame.depth;
    camera_ = frame.camera;
    unit_ = frame.metres_per_unit;
  }
  return repeats_ >= kRepeatsToRest;
}

}  // namespace lockbox
