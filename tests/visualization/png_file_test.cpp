// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <png.h>

#include "lockbox/core/error.hpp"
#include "lockbox/visualization/rgb_image.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

TEST(WritePng, IsReadBackByteForByte) {
  RgbImage image(5, 3);
  for (std::size_t i = 0; i < image.rgb.size(); ++i)
    image.rgb[i] = static_cast<std::uint8_t>(5 * i);
  const TemporaryFolder folder;
  const auto file = folder / "picture.png";
  write_png(file, image);

  png_image header = {};
  header.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_file(&header, file.c_str()), 0) << header.message;
  EXPECT_EQ(header.width, 5U);
  EXPECT_EQ(header.height, 3U);
  header.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> read(PNG_IMAGE_SIZE(header));
  ASSERT_NE(png_image_finish_read(&header, nullptr, read.data(), 0, nullptr), 0) << header.message;
  EXPECT_EQ(read, image.rgb);
}

TEST(WritePng, NamesTheFileThatCannotBeWritten) {
  try {
    write_png("/nowhere/picture.png", RgbImage(1, 1));
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("/nowhere/picture.png"), std::string::npos);
  }
}

}  // namespace
}  // namespace lockbox
