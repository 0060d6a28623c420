// SPDX-License-Identifier: BSD-3-Clause
// Contours and edges in a z-buffer: which pixels they pass, and which way.
//
// Written once with Highway, compiled for every instruction set, chosen at run time.
#pragma once

#include <cstddef>
#include <cstdint>

#include "lockbox/kernels/point_to_field.hpp"

namespace lockbox::kernels {

/// Three rows of a z-buffer, metres.
struct DepthRows {
  const float* above;
  const float* here;
  const float* below;
};

/// Writes the columns, in order, of the pixels whose 1 / depth bends from one neighbour to the
/// opposite one by more than `bend` (1 / metre), and returns how many. Not of those that show
/// nothing (an infinite depth), or have a neighbour that does. Pixels [first, end), which have
/// neighbours to all sides; columns: room for end - first + kLanes numbers.
std::size_t find_bends(const DepthRows& depths, std::size_t first, std::size_t end, float bend,
                       std::int32_t* columns);

inline constexpr int kVoteReach = 3;  ///< pixels around a pixel in which a contour counts as near
inline constexpr int kVoteRows = 2 * kVoteReach + 1;
inline constexpr int kVoteColumns = kVoteRows + 1;  ///< the last one is read, but does not count

/// The surface in a pixel, taken for a plane: 1 / depth is linear in an image of it.
struct PixelPlane {
  float depth;
  float slope_u;  ///< of 1 / depth, relative to the value here, per pixel
  float slope_v;
};

/// Three rows of what each pixel shows.
struct LabelRows {
  const std::int16_t* above;
  const std::int16_t* here;
  const std::int16_t* below;
};

/// Finds likewise the pixels that show something else than one of their neighbours, or whose depth
/// bends or jumps from one neighbour to the opposite one by more than the share `least_step` of it.
std::size_t find_edges(const DepthRows& depths, const LabelRows& labels, std::size_t first,
                       std::size_t end, float least_step, std::int32_t* columns);

/// In whole units, whose sums are exact in any order.
struct NormalVote {
  static constexpr int kUnit = 360;  ///< that all squared distances within reach divide
  int u = 0;
  int v = 0;
};

/// The sum over what lies beyond a contour: depths that are larger than that of the plane by the
/// share `step` of `plane.depth`. Each says its direction, less the farther it is. corner: of
/// kVoteRows x kVoteColumns depths, rows `stride` apart, the pixel in row and column kVoteReach.
NormalVote normal_vote(const float* corner, std::ptrdiff_t stride, const PixelPlane& plane,
                       float step);

}  // namespace lockbox::kernels
