// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lockbox {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t bytes_of(PlyType type);

struct PlyProperty {
  std::string_view name;
  PlyType type;                       ///< of the value, or of each value of the list
  std::optional<PlyType> count_type;  ///< of the list's length; none if it is no list
};

struct PlyElement {
  std::string_view name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  std::optional<std::endian> binary;  ///< none: text
  std::vector<PlyElement> elements;
  std::string_view body;
  int lines = 0;  ///< up to the body

  /// The element of this name; throws InputError if there is none, or more than one.
  const PlyElement& only(std::string_view name, const std::string& file) const;
};

/// Throws InputError with file and line.
PlyHeader read_ply_header(const std::string& file, std::string_view content);

}  // namespace lockbox
