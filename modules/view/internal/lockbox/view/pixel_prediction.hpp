// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace lockbox {

/// What the pixels of points are predicted to show, by point.
struct PixelPrediction {
  std::vector<float> body;   ///< number of the body, or kernels::label_beside
  std::vector<float> depth;  ///< metres; 0 where there is no body
};

}  // namespace lockbox
