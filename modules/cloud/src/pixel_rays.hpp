// SPDX-License-Identifier: BSD-3-Clause
// Rays of pixels in single precision: the same point for a pixel, whoever asks.
#pragma once

#include "lockbox/core/pinhole_camera.hpp"

namespace lockbox {

class PixelRays {
 public:
  explicit PixelRays(const PinholeCamera& camera)
      : cx_(static_cast<float>(camera.cx)),
        cy_(static_cast<float>(camera.cy)),
        per_fx_(static_cast<float>(1.0 / camera.fx)),
        per_fy_(static_cast<float>(1.0 / camera.fy)) {}

  /// Returns x of column u, as y() does of row v, metres per metre of depth.
  float x(int u) const { return (static_cast<float>(u) - cx_) * per_fx_; }
  float y(int v) const { return (static_cast<float>(v) - cy_) * per_fy_; }

 private:
  float cx_;
  float cy_;
  float per_fx_;
  float per_fy_;
};

}  // namespace lockbox
