// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace lockbox {

/// Colour picture, row by row, three bytes a pixel (red, green, blue).
struct RgbImage {
  /// Makes an image of one grey.
  RgbImage(int image_width, int image_height, std::uint8_t grey = 255)
      : width(image_width),
        height(image_height),
        rgb(3 * static_cast<std::size_t>(image_width) * static_cast<std::size_t>(image_height),
            grey) {}

  int width;                      ///< columns
  int height;                     ///< rows
  std::vector<std::uint8_t> rgb;  ///< 3 width height bytes
};

/// Throws InputError if the file cannot be written.
void write_png(const std::filesystem::path& file, const RgbImage& image);

}  // namespace lockbox
