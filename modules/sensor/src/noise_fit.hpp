// SPDX-License-Identifier: BSD-3-Clause
// Curves through what images tell of the noise.
#pragma once

#include <array>
#include <span>

#include "lockbox/sensor/noise_record.hpp"

namespace lockbox {

/// Of a second difference of errors that are not alike, beside that of an error: 1 + 4 + 1.
inline constexpr double kDifferenceVariance = 6.0;

/// How the noise grows with depth: floor + quadratic z^2 through the deviations of the bins, of a
/// lag at which errors are not alike. rounding: the unit of the depths, metres. False where that is
/// more than sensors err, which is the shape of what is seen, and where there is nothing.
bool fit_growth(const NoiseRecord::Bins& bins, double rounding, SensorNoise& noise);

/// How alike errors are, from the bins of the first lags: beside those of the last of them, at
/// which they are not alike.
void fit_correlation(std::span<const NoiseRecord::Bins> bins, SensorNoise& noise);

}  // namespace lockbox
