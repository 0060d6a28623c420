// SPDX-License-Identifier: BSD-3-Clause
// A folder of depth images: the text of depth.txt, a zero, and the bytes of one PNG image.
#include "lockbox/capture/depth_folder.hpp"

#include <zlib.h>

#include "fuzz_input.hpp"

namespace lockbox {
namespace {

std::uint32_t big_endian(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = at; i < at + 4; ++i) {
    value = value << 8U | static_cast<std::uint8_t>(bytes[i]);
  }
  return value;
}

/// With the checksums of its chunks made right: else nothing behind them is ever reached.
std::string with_checksums(std::string png) {
  constexpr std::size_t kSignature = 8;
  constexpr std::size_t kFrame = 12;  // of a chunk: its length, its type, its checksum
  for (std::size_t at = kSignature; at + kFrame <= png.size();) {
    const std::size_t length = big_endian(png, at);
    if (length > png.size() - at - kFrame) break;
    const auto* const checked = reinterpret_cast<const Bytef*>(png.data() + at + 4);
    const auto sum = static_cast<std::uint32_t>(crc32(0, checked, static_cast<uInt>(length + 4)));
    for (std::size_t i = 0; i < 4; ++i) {
      png[at + 8 + length + i] = static_cast<char>(sum >> (24 - 8 * i));
    }
    at += kFrame + length;
  }
  return png;
}

}  // namespace
}  // namespace lockbox

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lockbox;
  static const TemporaryFolder folder;
  static const auto camera = folder.write(
      "camera_info.yaml",
      "image_width: 16\nimage_height: 12\n"
      "camera_matrix: {rows: 3, cols: 3, data: [14.4, 0, 7.5, 0, 14.4, 5.5, 0, 0, 1]}\n");
  const std::string input = as_text(data, size);
  const std::size_t end = std::min(input.find('\0'), input.size());
  folder.write("depth.txt", input.substr(0, end));
  folder.write("image.png", with_checksums(input.substr(std::min(end + 1, input.size()))));
  take_or_refuse(folder, [&] {
    DepthFolderSource source(folder.path());
    for (DepthFrame frame; source.next(frame);) continue;
  });
  return 0;
}
