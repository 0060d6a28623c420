// SPDX-License-Identifier: BSD-3-Clause
// Where a z-buffer shows planes.
//
// Written once with Highway, compiled for every instruction set, chosen at run time.
#pragma once

#include <cstddef>
#include <cstdint>

#include "lockbox/kernels/contours.hpp"

namespace lockbox::kernels {

/// Writes 1 for each pixel of a z-buffer whose neighbours in its row and column show the same body
/// (a label of at least 0) in one plane, else 0: 1 / depth is linear in an image of a plane, and
/// may bend from one neighbour to the opposite one by no more than `bend` (1 / metre). Pixels
/// [first, end), which have neighbours to all sides; flat[0] is that of `first`.
void find_flat(const DepthRows& depths, const LabelRows& labels, std::size_t first, std::size_t end,
               float bend, std::uint8_t* flat);

}  // namespace lockbox::kernels
