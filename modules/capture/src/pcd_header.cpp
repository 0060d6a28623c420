// SPDX-License-Identifier: BSD-3-Clause
#include "pcd_header.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "image_limits.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/core/existing_path.hpp"
#include "lockbox/core/number_text.hpp"

namespace lockbox {
namespace {

constexpr std::size_t kMinimumPcdSize = 2;  // pixels
constexpr std::size_t kMaximumHeaderBytes = std::size_t{1} << 16U;

// PCL's richest points have some 50 bytes, those with a descriptor of 352 floats 1.4 kB. With the
// most pixels (image_limits.hpp) clouds above 1 GB are refused below.
constexpr std::size_t kMaximumPointBytes = 4096;
constexpr std::uint64_t kMaximumCloudBytes = std::uint64_t{1} << 30U;

// LZF writes at most 264 bytes for three: who promises more has no such data.
constexpr std::uint64_t kMaximumExpansion = 88;

using Words = std::vector<std::string>;

/// Keys are written in capitals; some programs do not. COLUMNS is the old name of FIELDS.
std::string key_of(std::string word) {
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::toupper(letter)); });
  return word == "COLUMNS" ? "FIELDS" : word;
}

class HeaderReader {
 public:
  explicit HeaderReader(const std::filesystem::path& file) : name_(file.string()) {
    std::ifstream in;
    if (is_file(file)) in.open(file, std::ios::binary);  // a pipe would wait for who writes into it
    if (!in.is_open()) {
      throw InputError(name_, "no such file, or it cannot be read");
    }
    std::string text(kMaximumHeaderBytes, '\0');
    in.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(in.gcount()));
    std::size_t begin = 0;
    for (std::size_t end = text.find('\n'); end != std::string::npos;
         end = text.find('\n', begin)) {
      const bool is_last = add_line(text.substr(begin, end - begin));
      begin = end + 1;
      if (is_last) {
        header_.begin = begin;
        header_.bytes = std::filesystem::file_size(file) - begin;
        return;
      }
    }
    throw InputError(name_,
                     text.empty() ? "is empty" : "is not a .pcd file: there is no line DATA");
  }

  PcdHeader check() {
    check_size();
    check_fields();
    check_data();
    return header_;
  }

 private:
  /// Returns whether the data begins after this line.
  bool add_line(const std::string& line) {
    std::istringstream in(line);
    std::string key;
    in >> key;
    key = key_of(key);
    if (key.empty() || key.front() == '#' || key == "VERSION" || key == "VIEWPOINT") {
      return false;
    }
    if (entries_.count(key) != 0) {
      throw InputError(name_, "the header has more than one line " + key);
    }
    Words& words = entries_[key];
    for (std::string word; in >> word;) {
      words.push_back(word);
    }
    return key == "DATA";
  }

  bool has(const std::string& key) const { return entries_.count(key) != 0; }

  const Words& words(const std::string& key) const {
    const auto found = entries_.find(key);
    if (found == entries_.end() || found->second.empty()) {
      throw InputError(name_, "the header lacks " + key);
    }
    return found->second;
  }

  std::size_t number(const std::string& key, std::size_t index) const {
    const Words& all = words(key);
    const std::optional<double> value =
        index < all.size() ? parse_finite_number(all[index]) : std::nullopt;
    if (!value || *value < 0.0 || *value > 1e9 ||
        *value != static_cast<double>(static_cast<std::size_t>(*value))) {
      throw InputError(name_, "the header's " + key + " is not a list of whole numbers");
    }
    return static_cast<std::size_t>(*value);
  }

  void check_size() {
    header_.width = number("WIDTH", 0);
    header_.height = has("HEIGHT") ? number("HEIGHT", 0) : 1;
    if (header_.height == 1) {
      throw InputError(name_,
                       "is not an organized cloud (HEIGHT 1): the pixels of the depth image are "
                       "lost; save the clouds as the camera delivers them");
    }
    if (header_.width < kMinimumPcdSize || header_.height < kMinimumPcdSize ||
        !is_image_size(header_.width, header_.height) ||
        (has("POINTS") && number("POINTS", 0) != header_.points())) {
      throw InputError(name_, "WIDTH, HEIGHT and POINTS do not describe an image of at most " +
                                  std::to_string(kMaximumImagePixels) + " pixels");
    }
  }

  void check_fields() {
    const Words& fields = words("FIELDS");
    std::array<int, 3> found{};
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const std::size_t size = has("SIZE") ? number("SIZE", i) : sizeof(float);
      const std::size_t count = has("COUNT") ? number("COUNT", i) : 1;
      const std::size_t axis = fields[i].size() == 1 ? std::string("xyz").find(fields[i]) : 3;
      if (axis < 3 && count == 1 && is_real(i, size)) {
        header_.coordinates.at(axis) = {header_.point_bytes, header_.point_values, size};
        ++found.at(axis);
      }
      if (size > kMaximumPointBytes || count > kMaximumPointBytes) {
        header_.point_bytes = kMaximumPointBytes;
      }
      header_.point_bytes += size * count;
      header_.point_values += count;
      if (header_.point_bytes > kMaximumPointBytes) {
        throw InputError(name_, "its points have more than " + std::to_string(kMaximumPointBytes) +
                                    " bytes each");
      }
    }
    if (found != std::array<int, 3>{1, 1, 1}) {
      throw InputError(name_, "its points do not have coordinates x, y, z of type float");
    }
  }

  bool is_real(std::size_t field, std::size_t size) const {
    const bool is_float =
        !has("TYPE") || (field < words("TYPE").size() && key_of(words("TYPE")[field]) == "F");
    return is_float && (size == sizeof(float) || size == sizeof(double));
  }

  void check_data() {
    const std::uint64_t expected = std::uint64_t{header_.points()} * header_.point_bytes;
    if (expected > kMaximumCloudBytes) {
      throw InputError(name_, "is a cloud of more than 1 GB; save x, y and z only");
    }
    const std::string& kind = words("DATA").front();
    if (kind == "binary") {
      header_.data = PcdHeader::Data::binary;
      require(header_.bytes >= expected);
    } else if (kind == "binary_compressed") {
      header_.data = PcdHeader::Data::compressed;
      require(expected <= kMaximumExpansion * header_.bytes);
    } else if (kind == "ascii") {
      require(header_.bytes + 1 >= 2 * header_.points() * header_.point_values);
    } else {
      throw InputError(name_, "its DATA is neither ascii, binary nor binary_compressed");
    }
  }

  void require(bool is_long_enough) const {
    if (!is_long_enough) {
      throw InputError(name_,
                       "is truncated or damaged: its data is not as long as its header says");
    }
  }

  std::string name_;
  std::map<std::string, Words> entries_;
  PcdHeader header_;
};

}  // namespace

PcdHeader read_pcd_header(const std::filesystem::path& file) {
  return HeaderReader(file).check();
}

}  // namespace lockbox
