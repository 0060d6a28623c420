// SPDX-License-Identifier: BSD-3-Clause
// Images of a folder that are damaged, of another size, or missing.
#include <fstream>

#include "depth_folder_fixture.hpp"
#include "text_file.hpp"

namespace lockbox {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

TEST_F(DepthFolder, OneImageThatCannotBeUsedSpoilsOneFrame) {
  write(6);
  const auto image = [this](int number) {
    return path() / "depth" / ("00000" + std::to_string(number) + ".png");
  };
  write_text(image(0), "");                     // of a camera that warms up
  std::filesystem::resize_file(image(2), 500);  // of a full disk
  std::filesystem::remove(image(3));
  DepthFolderWriter(folder_ / "small").write(synthetic_frame(0, {8, 6, 9, 9, 3.5, 2.5}));
  std::filesystem::copy_file(folder_ / "small/depth/000000.png", image(4),
                             std::filesystem::copy_options::overwrite_existing);
  std::vector<std::string> warnings;
  SourceOptions options;
  options.warn = [&warnings](const std::string& text) { warnings.push_back(text); };
  DepthFolderSource source(path(), options);
  DepthFrame frame;
  for (std::uint64_t number = 0; number < 6; ++number) {
    ASSERT_TRUE(source.next(frame));
    const DepthFrame expected = synthetic_frame(number);
    const bool is_good = number == 1 || number == 5;
    EXPECT_EQ(frame.depth,
              is_good ? expected.depth : std::vector<std::uint16_t>(expected.depth.size(), 0))
        << number;
    EXPECT_EQ(frame.stamp, expected.stamp);
    EXPECT_EQ(frame.camera, expected.camera);
    EXPECT_EQ(frame.index, number);
  }
  EXPECT_FALSE(source.next(frame));
  EXPECT_EQ(source.faults().unreadable, 4U);
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("000000.png"), HasSubstr("4 of 6 frames")));
}

TEST_F(DepthFolder, ImagesThatAllCannotBeUsedAreRefused) {
  write(3);
  for (const auto& entry : std::filesystem::directory_iterator(path() / "depth")) {
    write_text(entry.path(), "");
  }
  EXPECT_THAT(
      [this] { DepthFolderSource{path()}; },
      ThrowsMessage<InputError>(AllOf(HasSubstr("none of its 3 frames"), HasSubstr("000000.png"))));
}

TEST_F(DepthFolder, AHugeImageIsRefusedBeforeMemoryIsTaken) {
  write(1);
  std::string png = read_text(path() / "depth" / "000000.png");
  // Width and height stand behind the signature and the name of the first chunk; its checksum is
  // that of 16384 x 16384, 16-bit grey.
  png.replace(16, 8, std::string("\0\0\x40\0\0\0\x40\0", 8));
  png.replace(29, 4, std::string("\xdc\x33\x93\x1b", 4));
  write_text(path() / "depth" / "000000.png", png);
  expect_refusal("16384x16384 pixels, more than the 16777216");
}

TEST_F(DepthFolder, DamagedAndForeignImagesAreNamed) {
  write(1);
  const std::filesystem::path image = path() / "depth" / "000000.png";
  const std::uintmax_t size = std::filesystem::file_size(image);
  std::filesystem::resize_file(image, size / 2);
  expect_refusal("000000.png: is damaged or truncated");
  write_text(image, "no image");
  expect_refusal("000000.png: is not a sound PNG image");
}

}  // namespace
}  // namespace lockbox
