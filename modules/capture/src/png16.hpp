// SPDX-License-Identifier: BSD-3-Clause
// 16-bit grey PNG images, bit for bit.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace lockbox {

struct Image16 {
  int width = 0;
  int height = 0;
  std::vector<std::uint16_t> pixels;  ///< row by row
};

/// Reads into image, whose buffer is reused. Throws InputError if the file is missing, damaged, or
/// not 16-bit grey.
void read_png16(const std::filesystem::path& file, Image16& image);

/// pixels: width * height values. Throws InputError if the file cannot be written.
void write_png16(const std::filesystem::path& file, int width, int height,
                 const std::vector<std::uint16_t>& pixels);

}  // namespace lockbox
