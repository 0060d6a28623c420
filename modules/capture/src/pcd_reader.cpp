// SPDX-License-Identifier: BSD-3-Clause
#include "pcd_reader.hpp"

#include <cstring>
#include <fstream>
#include <iomanip>
#include <limits>
#include <string_view>

#include "lockbox/core/error.hpp"
#include "lockbox/core/number_text.hpp"
#include "pcd_header.hpp"

namespace lockbox {
namespace {

constexpr int kMaximumWord = 64;  // characters of a number: doubles need 25

[[noreturn]] void refuse_damaged(const std::string& name) {
  throw InputError(name, "is truncated or damaged: its data is not as long as its header says");
}

float coordinate_at(const char* bytes, std::size_t size) {
  if (size == sizeof(double)) {
    double value = 0.0;
    std::memcpy(&value, bytes, sizeof(value));
    return static_cast<float>(value);
  }
  float value = 0.0F;
  std::memcpy(&value, bytes, sizeof(value));
  return value;
}

/// Windows writes nan as `-1.#IND` or `1.#QNAN`.
float coordinate_in(const std::string& word, const std::string& name) {
  if (word.find(".#") != std::string::npos) {
    return std::numeric_limits<float>::quiet_NaN();
  }
  const std::optional<double> value = parse_number(word);
  if (!value) {
    throw InputError(name, "is damaged: " + in_quotes(word) + " is not a number");
  }
  return static_cast<float>(*value);
}

void read_text(std::istream& in, const PcdHeader& header, const std::string& name,
               OrganizedCloud& cloud) {
  std::string word;
  for (std::size_t point = 0; point < header.points(); ++point) {
    for (std::size_t value = 0; value < header.point_values; ++value) {
      if (!(in >> std::setw(kMaximumWord) >> word)) {
        refuse_damaged(name);
      }
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (header.coordinates.at(axis).value == value) {
          cloud.xyz[3 * point + axis] = coordinate_in(word, name);
        }
      }
    }
  }
  if (in >> word) {
    refuse_damaged(name);
  }
}

void read_binary(std::istream& in, const PcdHeader& header, const std::string& name,
                 OrganizedCloud& cloud) {
  std::vector<char> row(header.width * header.point_bytes);
  float* out = cloud.xyz.data();
  for (std::size_t v = 0; v < header.height; ++v) {
    if (!in.read(row.data(), static_cast<std::streamsize>(row.size()))) {
      refuse_damaged(name);
    }
    for (const char* point = row.data(); point != row.data() + row.size();
         point += header.point_bytes) {
      for (const PcdCoordinate& coordinate : header.coordinates) {
        *out++ = coordinate_at(point + coordinate.offset, coordinate.size);
      }
    }
  }
}

/// Compressed clouds hold the first field of all points, then the second, and so on.
void read_compressed(std::istream& in, const PcdHeader& header, const std::string& name,
                     OrganizedCloud& cloud) {
  const std::uint64_t expected = std::uint64_t{header.points()} * header.point_bytes;
  std::array<std::uint32_t, 2> sizes{};  // compressed, uncompressed
  if (!in.read(reinterpret_cast<char*>(sizes.data()), sizeof(sizes)) || sizes[1] != expected ||
      header.bytes < sizeof(sizes) + sizes[0]) {
    refuse_damaged(name);
  }
  std::vector<char> packed(sizes[0] + kLzfPadding);
  std::vector<char> fields(expected);
  if (!in.read(packed.data(), static_cast<std::streamsize>(sizes[0])) ||
      !decompress_lzf(packed, fields)) {
    refuse_damaged(name);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const PcdCoordinate& coordinate = header.coordinates.at(axis);
    const char* value = fields.data() + coordinate.offset * header.points();
    for (std::size_t point = 0; point < header.points(); ++point, value += coordinate.size) {
      cloud.xyz[3 * point + axis] = coordinate_at(value, coordinate.size);
    }
  }
}

}  // namespace

void load_pcd(const std::filesystem::path& file, OrganizedCloud& cloud) {
  const std::string name = file.string();
  const PcdHeader header = read_pcd_header(file);
  std::ifstream in(file, std::ios::binary);
  in.imbue(std::locale::classic());
  in.seekg(static_cast<std::streamoff>(header.begin));
  cloud.width = static_cast<int>(header.width);
  cloud.height = static_cast<int>(header.height);
  cloud.xyz.resize(3 * header.points());
  switch (header.data) {
    case PcdHeader::Data::text:
      return read_text(in, header, name, cloud);
    case PcdHeader::Data::binary:
      return read_binary(in, header, name, cloud);
    case PcdHeader::Data::compressed:
      return read_compressed(in, header, name, cloud);
  }
}

}  // namespace lockbox
