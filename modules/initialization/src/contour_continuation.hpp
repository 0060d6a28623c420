// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lockbox/rendering/depth_renderer.hpp"
#include "lockbox/verification/coarse_view.hpp"

namespace lockbox {

/// Returns, of the contour of what is drawn, against which the camera sees farther or just as far,
/// the share (0 to 1) across which the measured surface continues as the drawn one would if it did
/// not end there. A contour inside of which nothing was measured counts half. image: drawn by the
/// view's camera. noise: standard deviation of 1/depth of a pixel of the view, 1/metre. slack:
/// metres that surfaces may be off.
double share_that_continues(const RenderedDepth& image, const CoarseView& view, double noise,
                            double slack);

}  // namespace lockbox
