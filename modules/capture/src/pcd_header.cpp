// SPDX-License-Identifier: BSD-3-Clause
#include "pcd_header.hpp"

#include <array>
#include <cstdint>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "image_limits.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/core/number_text.hpp"

namespace lockbox {
namespace {

constexpr std::size_t kMinimumPcdSize = 2;  // pixels
constexpr int kMaximumHeaderLines = 100;
constexpr std::size_t kMaximumPointBytes = 4096;

class PcdHeader {
 public:
  explicit PcdHeader(const std::filesystem::path& file)
      : name_(file.string()), in_(file, std::ios::binary) {
    if (!in_) {
      throw InputError(name_, "no such file, or it cannot be read");
    }
    in_.imbue(std::locale::classic());
    std::string line;
    for (int i = 0; i < kMaximumHeaderLines && std::getline(in_, line); ++i) {
      std::istringstream words(line);
      std::string key;
      std::string word;
      words >> key;
      if (key.empty() || key.front() == '#') {
        continue;
      }
      while (words >> word) {
        entries_[key].push_back(word);
      }
      if (key == "DATA") {
        data_ = static_cast<std::uint64_t>(in_.tellg());
        bytes_of_data_ = std::filesystem::file_size(file) - data_;
        return;
      }
    }
    throw InputError(name_, "is not a .pcd file: there is no line DATA");
  }

  void check() {
    const std::size_t width = number("WIDTH", 0);
    const std::size_t height = number("HEIGHT", 0);
    if (height == 1) {
      throw InputError(name_,
                       "is not an organized cloud (HEIGHT 1): the pixels of the depth image are "
                       "lost; save the clouds as the camera delivers them");
    }
    if (width < kMinimumPcdSize || width > kMaximumImageSize || height < kMinimumPcdSize ||
        height > kMaximumImageSize || number("POINTS", 0) != width * height) {
      throw InputError(name_, "WIDTH, HEIGHT and POINTS do not describe an image");
    }
    const std::size_t point_bytes = check_fields();
    check_data(width * height * point_bytes);
  }

 private:
  const std::vector<std::string>& words(const std::string& key) {
    if (entries_[key].empty()) {
      throw InputError(name_, "the header lacks " + key);
    }
    return entries_[key];
  }

  std::size_t number(const std::string& key, std::size_t index) {
    const std::vector<std::string>& all = words(key);
    const std::optional<double> value =
        index < all.size() ? parse_finite_number(all[index]) : std::nullopt;
    if (!value || *value < 0.0 || *value > 1e9 ||
        *value != static_cast<double>(static_cast<std::size_t>(*value))) {
      throw InputError(name_, "the header's " + key + " is not a list of whole numbers");
    }
    return static_cast<std::size_t>(*value);
  }

  /// Returns the bytes of a point.
  std::size_t check_fields() {
    const std::vector<std::string> fields = words("FIELDS");
    std::size_t bytes = 0;
    std::size_t coordinates = 0;
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const std::size_t size = number("SIZE", i);
      const std::size_t count = entries_.count("COUNT") != 0 ? number("COUNT", i) : 1;
      const bool is_coordinate = fields[i] == "x" || fields[i] == "y" || fields[i] == "z";
      if (is_coordinate && size == 4 && count == 1 && i < words("TYPE").size() &&
          words("TYPE")[i] == "F") {
        ++coordinates;
      }
      bytes += size * count;
    }
    if (coordinates != 3 || bytes > kMaximumPointBytes) {
      throw InputError(name_, "its points do not have coordinates x, y, z of type float");
    }
    return bytes;
  }

  void check_data(std::size_t expected) {
    const std::string kind = words("DATA").front();
    if (kind == "binary") {
      require(bytes_of_data_ >= expected);
    } else if (kind == "binary_compressed") {
      std::array<std::uint32_t, 2> sizes{};  // compressed, uncompressed
      in_.read(reinterpret_cast<char*>(sizes.data()), sizeof(sizes));
      require(in_ && sizes[1] == expected && bytes_of_data_ >= sizeof(sizes) + sizes[0]);
    } else if (kind != "ascii") {
      throw InputError(name_, "its DATA is neither ascii, binary nor binary_compressed");
    }
  }

  void require(bool complete) const {
    if (!complete) {
      throw InputError(name_,
                       "is truncated or damaged: its data is not as long as its header says");
    }
  }

  std::string name_;
  std::ifstream in_;
  std::map<std::string, std::vector<std::string>> entries_;
  std::uint64_t data_ = 0;
  std::uint64_t bytes_of_data_ = 0;
};

}  // namespace

void check_pcd(const std::filesystem::path& file) {
  PcdHeader(file).check();
}

}  // namespace lockbox
