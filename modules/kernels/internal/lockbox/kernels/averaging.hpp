// SPDX-License-Identifier: BSD-3-Clause
// How far pixels of a depth image lie from a plane, in the mean.
//
// Written once with Highway, compiled for every instruction set, chosen at run time.
#pragma once

#include <cstddef>

namespace lockbox::kernels {

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
struct AveragedDeviation {
  float pixels = 0.0F;
  float mean = 0.0F;
  float variance = 0.0F;  ///< of one of them
};

/// First the mean of those within `reach` of the plane, then of those within `gate` of that mean: a
/// gate around the plane itself would draw the mean to where the plane is expected.
AveragedDeviation average_deviations(const DepthBlock& block, const NearnessPlane& plane,
                                     float reach, float gate);

}  // namespace lockbox::kernels
