// SPDX-License-Identifier: BSD-3-Clause
// Where the pixels of a z-buffer have gone, once its bodies have moved, and what was measured
// there.
//
// Written once with Highway, compiled for every instruction set, chosen at run time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "lockbox/kernels/point_to_field.hpp"

namespace lockbox::kernels {

/// A pinhole camera, pixels; pixel centres at integers.
struct Intrinsics {
  float fx;
  float fy;
  float cx;
  float cy;
  std::int32_t width;
  std::int32_t height;
};

/// One row of a z-buffer.
struct DrawnRow {
  const float* depth;      ///< metres, by column
  const std::int16_t* id;  ///< body of each column; negative: nothing is drawn there
  std::size_t columns;
  std::int32_t row;
};

/// A measured depth image in metres, row by row, 0 where nothing is known.
struct MeasuredDepth {
  const float* depth;
  Intrinsics camera;
};

inline constexpr std::int32_t kOutside = -1;  ///< no pixel of the image, or nothing is drawn
inline constexpr std::int32_t kUndecided =
    -2;  ///< so near two pixels' border that rounding decides

/// By column; arrays of padded(columns).
struct Reprojected {
  float* expected;      ///< depth of the drawn point after its body's motion, metres
  float* measured;      ///< in the pixel that it falls into; 0 without one
  std::int32_t* pixel;  ///< index in the measured image, kOutside or kUndecided
};

/// drawn: the camera of the z-buffer. motion[id]: of that body since it was drawn, in the camera's
/// frame.
void reproject(const DrawnRow& row, const Intrinsics& drawn, std::span<const RigidMotion> motion,
               const MeasuredDepth& image, const Reprojected& result);

/// Writes the columns, in order, of which the measured depth exceeds the expected one by more than
/// zone standard deviations, and those that are undecided; returns how many. columns: of the row,
/// and the least size of the array.
std::size_t seen_through(const Reprojected& row, std::size_t columns, const PointNoise& noise,
                         float zone, std::uint32_t* result);

}  // namespace lockbox::kernels
