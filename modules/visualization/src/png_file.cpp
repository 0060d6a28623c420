// SPDX-License-Identifier: BSD-3-Clause
#include <png.h>

#include "lockbox/core/error.hpp"
#include "lockbox/visualization/rgb_image.hpp"

namespace lockbox {

void write_png(const std::filesystem::path& file, const RgbImage& image) {
  png_image header = {};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width);
  header.height = static_cast<png_uint_32>(image.height);
  header.format = PNG_FORMAT_RGB;
  const int written =
      png_image_write_to_file(&header, file.c_str(), 0, image.rgb.data(), 0, nullptr);
  if (written == 0) throw InputError(file.string(), header.message);
}

}  // namespace lockbox
