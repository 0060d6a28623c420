// SPDX-License-Identifier: BSD-3-Clause
// How well what is drawn in a row of pixels explains what was measured there.
//
// Written once with Highway, compiled for every instruction set, chosen at run time.
#pragma once

#include <cstddef>
#include <cstdint>

#include "lockbox/kernels/contours.hpp"

namespace lockbox::kernels {

/// A row of a view, metres; 0 where nothing was measured.
struct MeasuredRow {
  const float* depth;
  const float* nearest;  ///< of a pixel and its eight neighbours
};

/// What a view errs by, and what its pixels count.
struct PixelScoring {
  float noise;             ///< of 1 / depth, standard deviation, 1 / metre
  float slack;             ///< metres that surfaces may be off
  float pixels_per_metre;  ///< at a depth of one metre
  /// What stands before it, metres, by more than three standard deviations says nothing.
  float reach;
  float occluded;   ///< what a pixel counts with something in front, where one explained counts 1
  float violating;  ///< the same of one through which the camera saw
};

/// Writes the scores of the pixels [first, end), which have neighbours to all sides; scores[0] is
/// that of `first`. It is 0 where nothing is drawn (a negative label) or was measured. Where the
/// difference of both depths is d, and its standard deviation s, it is 1 - 0.22 (d / s)^2, but for
/// what stands in front, or was seen through. s grows with the slope of what is drawn, which is
/// taken from those neighbours that show the same body.
void score_pixels(const DepthRows& depths, const LabelRows& labels, const MeasuredRow& measured,
                  std::size_t first, std::size_t end, const PixelScoring& scoring, float* scores);

}  // namespace lockbox::kernels
