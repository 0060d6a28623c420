// SPDX-License-Identifier: BSD-3-Clause
// What a window of samples of a rendering shows, blurred along its columns, by body: of inverse
// depths d, and of the steps between neighbouring samples, which the nearer one moves.
//
// Written once with Highway, compiled for every instruction set, chosen at run time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace lockbox::kernels {

/// Samples along each side of a window; the last column and row are there for whole vectors of
/// neighbours.
inline constexpr std::size_t kWindowSide = 32;
inline constexpr std::size_t kWindowPixels = 8;     ///< along each side
inline constexpr std::size_t kSamplesPerPixel = 3;  ///< along each side
/// Pixel i of a row or column looks at samples 3 i .. 3 i + 8.
inline constexpr std::size_t kWindowTaps = 9;

/// Of a larger rendering, from the window's first sample on.
struct EdgeWindow {
  const float* d;            ///< 1/metre; 0: nothing
  const std::int16_t* body;  ///< a number
  std::size_t stride;        ///< from row to row
};

struct WindowTaps {
  std::array<float, kWindowTaps> at_samples;       ///< a density at samples
  std::array<float, kWindowTaps> between_samples;  ///< half a sample after them
};

/// Pixels of a row. Only the columns of samples that they look at are summed, and some beside them.
struct PixelRange {
  std::size_t first;
  std::size_t end;
};

/// Sums over the samples of a column. step: d of the next sample less that of this one, a step each
/// pixel, by the body of the nearer of both; along rows (u) and columns (v).
struct ColumnMoments {
  using Sums = std::array<float, kWindowSide>;
  alignas(64) Sums d;
  alignas(64) Sums d_squared;
  alignas(64) Sums step_u;
  alignas(64) Sums step_u_d;  ///< times d of the nearer
  alignas(64) Sums step_v;
  alignas(64) Sums step_v_d;
};

/// Blurs the moments of one body, around pixels of a row.
void blur_columns(const EdgeWindow& window, const WindowTaps& taps, std::size_t pixel_row,
                  const PixelRange& pixels, std::int16_t body, ColumnMoments& moments);

/// Blurs (d - reference)^2 of all bodies.
void blur_squares(const EdgeWindow& window, const WindowTaps& taps, std::size_t pixel_row,
                  const PixelRange& pixels, float reference, ColumnMoments::Sums& squares);

/// The pixels of a row, bit by bit, whose d bends towards that of their neighbours by more than
/// this; not where one of them shows nothing.
std::uint32_t find_bending(const EdgeWindow& window, std::size_t pixel_row, float least);

}  // namespace lockbox::kernels
