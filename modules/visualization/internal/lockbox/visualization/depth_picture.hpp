// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lockbox/core/depth_frame.hpp"
#include "lockbox/visualization/rgb_image.hpp"

namespace lockbox {

/// The frame in greys: near is bright, far is dark, black where nothing was measured.
RgbImage depth_picture(const DepthFrame& frame);

}  // namespace lockbox
