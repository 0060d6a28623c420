// SPDX-License-Identifier: BSD-3-Clause
// Contrast: how much a pixel's residual differs from those around it. The noise of neighbouring
// pixels goes together, so that low relief, lost in the noise of depths, stands out by its edges.
#pragma once

#include <cstddef>
#include <vector>

namespace lockbox {

/// Of inverse depths, in standard deviations of a pixel; NaN where there is none.
struct ResidualImage {
  int width = 0;
  int height = 0;
  std::vector<float> values;  ///< row by row

  /// Without residuals.
  void resize(int columns, int rows);
  float at(int u, int v) const {
    return values[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(u)];
  }
};

/// A number of pixels: those whose residual is that of the pixels around them, less those where it
/// is not.
double evenness(const ResidualImage& residuals);

}  // namespace lockbox
