// SPDX-License-Identifier: BSD-3-Clause
// From what a sensor measured to the depth image that is looked at.
//
// Written once with Highway, compiled for every instruction set, chosen at run time.
#pragma once

#include <cstddef>
#include <cstdint>

#include "lockbox/kernels/contours.hpp"

namespace lockbox::kernels {

/// Which depths are kept.
struct DepthFilter {
  float min_depth;    ///< metres
  float max_depth;    ///< metres
  float jump_factor;  ///< 1/metre, of the squared depth; infinite: keeps what flies
};

/// Depths in the sensor's units, times that.
void scale_depths(const std::uint16_t* units, std::size_t count, float metres_per_unit,
                  float* metres);

/// Writes a row: depths that are kept, and 0 for others. A depth flies where both neighbours of its
/// row, or of its column, were measured, and both differ from it by more than the jump. depths: of
/// its pixels, 0 where nothing was measured; beside the first and the last pixel, too.
void filter_depths(const DepthRows& depths, std::size_t width, const DepthFilter& filter,
                   float* kept);

}  // namespace lockbox::kernels
