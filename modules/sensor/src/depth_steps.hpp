// SPDX-License-Identifier: BSD-3-Clause
// A sensor that rounds disparities gives few depths: at two metres a PrimeSense's are 11 mm apart.
#pragma once

#include <array>

#include "lockbox/core/depth_frame.hpp"
#include "lockbox/sensor/noise_record.hpp"

namespace lockbox {

/// Returns by bin of depths how far one depth that the image has is from the next one, metres, in
/// the median over its pixels; 0 where too few pixels tell. What errs by much more than a unit has
/// all depths, and what is rounded has few, whatever is seen.
std::array<double, NoiseRecord::kBins> depth_steps(const DepthFrame& frame);

}  // namespace lockbox
