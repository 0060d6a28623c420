// SPDX-License-Identifier: BSD-3-Clause
// The header of a .pcd file, checked. Nothing else of the file is believed afterwards.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>

namespace lockbox {

/// Where a coordinate of a point stands.
struct PcdCoordinate {
  std::size_t offset = 0;  ///< bytes from the beginning of the point
  std::size_t value = 0;   ///< number of the value in a point that is written as text
  std::size_t size = 4;    ///< bytes: a float, or 8, a double
};

/// An organized cloud with coordinates x, y, z, whose sizes were checked.
struct PcdHeader {
  enum class Data { text, binary, compressed };

  std::size_t width = 0;
  std::size_t height = 0;
  Data data = Data::text;
  std::array<PcdCoordinate, 3> coordinates{};
  std::size_t point_bytes = 0;
  std::size_t point_values = 0;
  std::uint64_t begin = 0;  ///< of the data, bytes from the beginning of the file
  std::uint64_t bytes = 0;  ///< from there to the end of the file

  std::size_t points() const { return width * height; }
};

/// Throws InputError unless the file is an organized cloud with coordinates x, y, z, of a size that
/// is read (image_limits.hpp), and long enough to hold what its header says.
PcdHeader read_pcd_header(const std::filesystem::path& file);

}  // namespace lockbox
