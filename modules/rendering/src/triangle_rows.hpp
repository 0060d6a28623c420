// SPDX-License-Identifier: BSD-3-Clause
// Scan conversion of one triangle.
#pragma once

#include <cstddef>
#include <cstdint>

#include "lockbox/rendering/depth_renderer.hpp"
#include "screen_triangle.hpp"

namespace lockbox::rendering {

/// The most rows that can be drawn at once.
inline constexpr int kBandRows = 16;

/// What is drawn upon: a window of the camera's image, row by row.
struct Canvas {
  ImageWindow window;
  float* inverse_z;  ///< 0 is infinitely far
  std::int16_t* ids;

  /// Returns the index of a column and row of the camera's image in these arrays.
  std::size_t index(int u, int v) const {
    return static_cast<std::size_t>(v - window.top) * static_cast<std::size_t>(window.width) +
           static_cast<std::size_t>(u - window.left);
  }
};

/// Draws the rows of a triangle that lie in [first_row, end_row), at most kBandRows of them, where
/// it is nearer than what is there.
void draw_rows(const ScreenTriangle& triangle, int first_row, int end_row, const Canvas& canvas);

}  // namespace lockbox::rendering
