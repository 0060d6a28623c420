// SPDX-License-Identifier: BSD-3-Clause
// From part of a depth image to the points that it shows.
//
// Written once with Highway, compiled for every instruction set, chosen at run time.
#pragma once

#include <cstddef>
#include <cstdint>

#include "lockbox/kernels/point_to_field.hpp"

namespace lockbox::kernels {

inline constexpr std::size_t kMostTileColumns = kLanes;

/// Rows and columns of a depth image in metres, 0 where nothing is known.
struct DepthTile {
  const float* depth;      ///< of its first pixel
  const float* ray_x;      ///< by column, metres per metre of depth; kMostTileColumns of them
  const float* ray_y;      ///< by row
  std::uint32_t pixel;     ///< number of its first pixel
  std::uint32_t next_row;  ///< pixels from row to row
  std::size_t columns;     ///< at most kMostTileColumns
  std::size_t rows;
};

/// Room for columns x rows points, metres, and the numbers of their pixels.
struct PointSlots {
  float* x;
  float* y;
  float* z;
  std::uint32_t* pixel;
};

/// Of points: x, y, z. Of none: the largest and the lowest number.
struct PointBounds {
  float min[3];
  float max[3];
};

/// Writes the points of the known pixels, row by row, and their bounds; returns how many.
std::size_t back_project(const DepthTile& tile, const PointSlots& slots, PointBounds& bounds);

}  // namespace lockbox::kernels
