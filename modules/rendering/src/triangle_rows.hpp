// SPDX-License-Identifier: BSD-3-Clause
// Scan conversion of one triangle.
#pragma once

#include "lockbox/rendering/depth_renderer.hpp"
#include "screen_triangle.hpp"

namespace lockbox::rendering {

/// The most rows that can be drawn at once.
inline constexpr int kBandRows = 16;

/// Draws the rows of a triangle that lie in [first_row, end_row), at most kBandRows of them, where
/// it is nearer than what is there. The image shows that window of the camera's. Until it is
/// complete, its depths hold 1/z: 0 is infinitely far.
void draw_rows(const ScreenTriangle& triangle, const ImageWindow& window, int first_row,
               int end_row, RenderedDepth& image);

}  // namespace lockbox::rendering
