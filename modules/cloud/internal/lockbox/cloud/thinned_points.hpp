// SPDX-License-Identifier: BSD-3-Clause
// Some of the points of a cloud with an image: a grid of pixels that is finer here, coarser there.
#pragma once

#include <cstdint>
#include <vector>

#include "lockbox/cloud/point_tiles.hpp"
#include "lockbox/cloud/tiled_cloud.hpp"

namespace lockbox {

/// How densely an image is sampled, cell by cell. Pixels are those of a view that may be coarser
/// than the image itself: blocks of scale x scale pixels.
struct SamplingDensity {
  static constexpr int kCellSize = 8;  ///< pixels of the view along each side of a cell

  int columns = 0;  ///< of cells
  int rows = 0;
  int scale = 1;
  /// By cell, row by row: pixels of the view from one sample to the next along rows and columns,
  /// a power of two up to kCellSize; 0: no samples.
  std::vector<std::uint8_t> spacing;

  /// The first sample along rows and columns of a cell that has any.
  static int first_sample(int spacing) { return spacing / 2; }
};

/// Buffers are reused: assign() allocates only where there are more points than ever before.
class ThinnedPoints : public PointTiles {
 public:
  /// A point stands for all pixels up to the next one. The cloud must have an image.
  void assign(const TiledCloud& cloud, const SamplingDensity& density);

 private:
  class Gatherer;
};

}  // namespace lockbox
