// SPDX-License-Identifier: BSD-3-Clause
// Where in the image points of a body are, and what was measured there.
//
// Written once with Highway, compiled for every instruction set, chosen at run time.
#pragma once

#include <cstddef>
#include <cstdint>

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

/// A measured depth image in metres, row by row, 0 where nothing is known.
struct MeasuredDepth {
  const float* depth;
  Intrinsics camera;
};

inline constexpr std::int32_t kOutside = -1;  ///< no pixel of the image
inline constexpr std::int32_t kUndecided =
    -2;  ///< so near two pixels' border that rounding decides

/// By point; arrays of PointSpan::size.
struct Landings {
  float* expected;      ///< depth of the point, metres
  float* x;             ///< of what was measured in the pixel that it falls into, camera's frame
  float* y;             ///< likewise
  float* measured;      ///< its depth; 0 without a pixel
  std::int32_t* pixel;  ///< index in the image, kOutside or kUndecided
};

/// points: in the frame of a body.
void land(const PointSpan& points, const RigidMotion& camera_from_body, const MeasuredDepth& image,
          const Landings& result);

/// Writes the numbers, in order, of the points whose measured depth exceeds the expected one by
/// more than zone standard deviations, and of those that are undecided; returns how many. count: of
/// the points that are no padding, and the least size of the array.
std::size_t free_space_violations(const Landings& landings, std::size_t count,
                                  const PointNoise& noise, float zone, std::uint32_t* result);

}  // namespace lockbox::kernels
