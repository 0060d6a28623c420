// SPDX-License-Identifier: BSD-3-Clause
// How a sensor errs, from one of its images.
//
// Along a row 1/z is linear on any plane. So its second differences at a distance of k pixels,
//
//   D_k(u) = d(u - k) - 2 d(u) + d(u + k),   d = 1/z,
//
// are noise on planes, which most of an image shows; the rest (edges, curved faces) are outliers.
// Of errors that correlate by rho, var D_k = s^2 (6 - 8 rho(k) + 2 rho(2 k)): large k tell s, and
// how it grows with k tells how alike neighbours err. Not seen is what is alike over more than a
// dozen pixels, and what a whole face is off: that takes a profile.
#pragma once

#include <optional>

#include "lockbox/core/depth_frame.hpp"
#include "lockbox/sensor/sensor_noise.hpp"

namespace lockbox {

/// The noise along the ray and how it correlates; across the ray as SensorNoise has it. Takes about
/// as long as a frame; depends on nothing but the image. None if the image shows too little.
std::optional<SensorNoise> estimate_noise(const DepthFrame& frame);

}  // namespace lockbox
