// SPDX-License-Identifier: BSD-3-Clause
// Curves through what images tell of the noise.
#pragma once

#include <array>
#include <span>

#include "lockbox/sensor/noise_record.hpp"

namespace lockbox {

/// Of a second difference of errors that are not alike, beside that of an error: 1 + 4 + 1.
inline constexpr double kDifferenceVariance = 6.0;

/// The noise along the ray and how alike it is, from the bins of the first lags, of which what
/// bends was left out. It grows with depth as floor + quadratic z^2 through the deviations of the
/// bins of the last of these lags. rounding: the unit of the depths, metres. False where that is
/// more than sensors err, which is the shape of what is seen, and where there is nothing.
bool fit_noise(std::span<const NoiseRecord::Bins> bins, double rounding, SensorNoise& noise);

}  // namespace lockbox
