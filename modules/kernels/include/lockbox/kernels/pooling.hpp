// SPDX-License-Identifier: BSD-3-Clause
// Pixels that a model is predicted to show as one flat face, and their mean.
//
// Written once with Highway, compiled for every instruction set, chosen at run time.
#pragma once

#include <cstddef>
#include <cstdint>

#include "lockbox/kernels/outlines.hpp"

namespace lockbox::kernels {

/// Writes 1 for each pixel of a z-buffer whose neighbours in its row and column show the same body
/// (a label of at least 0) in one plane, else 0: 1 / depth is linear in an image of a plane, and
/// may bend from one neighbour to the opposite one by no more than what `bend` metres at the
/// pixel's depth are. Pixels [first, end), which have neighbours to all sides; flat[0] is that of
/// `first`.
void find_flat(const DepthRows& depths, const LabelRows& labels, std::size_t first, std::size_t end,
               float bend, std::uint8_t* flat);

/// A rectangle of a depth image, metres, 0 where nothing was measured.
struct DepthBlock {
  const float* first;
  std::size_t stride;  ///< from row to row
  std::size_t width;
  std::size_t height;
};

/// 1 / depth of a plane at a block's first pixel, and from one column or row to the next.
struct NearnessPlane {
  float first;
  float per_column;
  float per_row;
};

/// Relative deviations measured / expected - 1 of the pixels that lie near each other.
struct PooledDeviation {
  float pixels = 0.0F;
  float mean = 0.0F;
  float variance = 0.0F;  ///< of one of them
};

/// First the mean of those within `reach` of the plane, then of those within `gate` of that mean: a
/// gate around the plane itself would draw the mean to where the plane is expected.
PooledDeviation pool_deviations(const DepthBlock& block, const NearnessPlane& plane, float reach,
                                float gate);

}  // namespace lockbox::kernels
