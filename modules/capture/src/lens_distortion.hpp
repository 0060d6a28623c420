// SPDX-License-Identifier: BSD-3-Clause
// The distortion of a calibration.
#pragma once

#include <vector>

#include "calibration_file.hpp"

namespace lockbox {

/// As CameraCalibration keeps it.
struct LensDistortion {
  std::vector<double> coefficients;
  bool is_equidistant = false;
};

/// Coefficients that a polynomial model does not have may follow if they are 0, as camera makers
/// and OpenCV write them. Throws InputError for models other than `plumb_bob`,
/// `rational_polynomial` and `equidistant`, unless they distort nothing.
LensDistortion read_distortion(const CalibrationFile& file);

}  // namespace lockbox
