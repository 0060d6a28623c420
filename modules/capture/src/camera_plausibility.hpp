// SPDX-License-Identifier: BSD-3-Clause
// Cameras that cannot be, or hardly can, because a number is in another unit.
#pragma once

#include <optional>
#include <string>

#include "lockbox/core/pinhole_camera.hpp"

namespace lockbox {

/// What is wrong with the focal length, if no depth camera sees so much or so little, and what to
/// do: millimetres, micrometres, or shares of the image's size instead of pixels.
std::optional<std::string> impossible_focal_length(const PinholeCamera& camera);

/// What is wrong with the principal point, if it is so far off that pixels look farther to the side
/// than those of any depth camera.
std::optional<std::string> impossible_principal_point(const PinholeCamera& camera);

/// What is doubtful about the principal point: far off the middle, as if the matrix were for
/// another resolution. Cut-outs of images may have such a one.
std::optional<std::string> doubtful_principal_point(const PinholeCamera& camera);

/// Says in messages about an image whose size is not the camera's what probably happened, and by
/// what factor the calibration would fit.
std::string size_advice(const PinholeCamera& camera, int width, int height);

}  // namespace lockbox
