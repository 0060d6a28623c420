// SPDX-License-Identifier: BSD-3-Clause
// The distortion of a calibration.
#pragma once

#include <vector>

#include "calibration_file.hpp"

namespace lockbox {

/// The coefficients as CameraCalibration keeps them; those that the model does not have may follow
/// if they are 0, as camera makers and OpenCV write them. Throws InputError for models other than
/// `plumb_bob` and `rational_polynomial`, unless they distort nothing.
std::vector<double> read_distortion(const CalibrationFile& file);

}  // namespace lockbox
