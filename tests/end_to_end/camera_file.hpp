// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "tool.hpp"

namespace lockbox {

/// Writes the calibration of a camera that sees 58 degrees across, three quarters as high as wide.
inline void write_camera_file(const std::string& file, int width) {
  const int height = 3 * width / 4;
  const std::string focal = std::to_string(0.9 * width);
  write_text(file, "image_width: " + std::to_string(width) + "\nimage_height: " +
                       std::to_string(height) + "\ncamera_matrix: {rows: 3, cols: 3, data: [" +
                       focal + ", 0, " + std::to_string(0.5 * (width - 1)) + ", 0, " + focal +
                       ", " + std::to_string(0.5 * (height - 1)) +
                       ", 0, 0, 1]}\ndistortion_model: plumb_bob\n"
                       "distortion_coefficients: {rows: 1, cols: 5, data: [0, 0, 0, 0, 0]}\n");
}

}  // namespace lockbox
