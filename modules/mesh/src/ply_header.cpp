// SPDX-License-Identifier: BSD-3-Clause
#include "ply_header.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "lockbox/core/error.hpp"
#include "tokens.hpp"

namespace lockbox {
namespace {

std::optional<PlyType> type_called(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, PlyType>, 16> kNames = {{
      {"char", PlyType::int8},
      {"int8", PlyType::int8},
      {"uchar", PlyType::uint8},
      {"uint8", PlyType::uint8},
      {"short", PlyType::int16},
      {"int16", PlyType::int16},
      {"ushort", PlyType::uint16},
      {"uint16", PlyType::uint16},
      {"int", PlyType::int32},
      {"int32", PlyType::int32},
      {"uint", PlyType::uint32},
      {"uint32", PlyType::uint32},
      {"float", PlyType::float32},
      {"float32", PlyType::float32},
      {"double", PlyType::float64},
      {"float64", PlyType::float64},
  }};
  const auto found = std::find_if(kNames.begin(), kNames.end(),
                                  [&](const auto& entry) { return entry.first == name; });
  return found == kNames.end() ? std::nullopt : std::optional(found->second);
}

class PlyHeaderReader {
 public:
  PlyHeaderReader(const std::string& file, std::string_view content)
      : file_(file), content_(content), lines_(content) {}

  PlyHeader read() {
    if (!next_line() || words_ != std::vector<std::string_view>{"ply"}) {
      refuse("not a PLY file: the first line is not 'ply'");
    }
    const bool ends_with_cr = behind_line().starts_with('\r') && !behind_line().starts_with("\r\n");
    PlyHeader header;
    while (next_line()) {
      if (words_.empty() || words_[0] == "comment" || words_[0] == "obj_info") {
        continue;
      }
      if (words_[0] == "end_header") {
        // Of a binary body, the first byte may look like the second of a line's end.
        const bool has_two = !ends_with_cr && behind_line().starts_with("\r\n");
        header.body = behind_line();
        header.body.remove_prefix(std::min<std::size_t>(has_two ? 2 : 1, header.body.size()));
        header.lines = lines_.number();
        return header;
      }
      entry(header);
    }
    refuse("the header has no end: the file is truncated");
  }

 private:
  bool next_line() {
    if (!lines_.next()) return false;
    words_.clear();
    std::string_view rest = lines_.text();
    // No entry has more than five words; comments may be long.
    for (auto word = take_word(rest); !word.empty() && words_.size() < 6; word = take_word(rest)) {
      words_.push_back(word);
    }
    return true;
  }

  std::string_view behind_line() const {
    const std::string_view line = lines_.text();
    return content_.substr(static_cast<std::size_t>(line.data() + line.size() - content_.data()));
  }

  void entry(PlyHeader& header) const {
    if (words_[0] == "format" && words_.size() == 3) {
      header.binary = byte_order(words_[1]);
    } else if (words_[0] == "element" && words_.size() == 3) {
      header.elements.push_back({words_[1], count(words_[2]), {}});
    } else if (words_[0] == "property" && !header.elements.empty()) {
      header.elements.back().properties.push_back(property());
    } else {
      refuse(in_quotes(lines_.text()) + " does not belong in a header");
    }
  }

  std::optional<std::endian> byte_order(std::string_view format) const {
    if (format == "ascii") return std::nullopt;
    if (format == "binary_little_endian") return std::endian::little;
    if (format == "binary_big_endian") return std::endian::big;
    refuse("unknown format " + in_quotes(format));
  }

  std::size_t count(std::string_view word) const {
    std::uint32_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size()) {
      refuse(in_quotes(word) + " is not a number of elements");
    }
    return value;
  }

  PlyProperty property() const {
    const bool is_list = words_.size() == 5 && words_[1] == "list";
    if (!is_list && words_.size() != 3) {
      refuse("a property needs a type and a name");
    }
    const auto type = type_called(words_[is_list ? 3 : 1]);
    const auto count_type = is_list ? type_called(words_[2]) : std::nullopt;
    if (!type || (is_list && !count_type)) {
      refuse("unknown type in " + in_quotes(lines_.text()));
    }
    return {words_.back(), *type, count_type};
  }

  [[noreturn]] void refuse(const std::string& problem) const {
    throw InputError(file_, std::max(lines_.number(), 1), problem);
  }

  const std::string& file_;
  std::string_view content_;
  Lines lines_;
  std::vector<std::string_view> words_;  ///< of the line
};

}  // namespace

std::size_t bytes_of(PlyType type) {
  constexpr std::array<std::size_t, 8> kBytes = {1, 1, 2, 2, 4, 4, 4, 8};
  return kBytes[static_cast<std::size_t>(type)];
}

const PlyElement& PlyHeader::only(std::string_view name, const std::string& file) const {
  const auto is_named = [&](const PlyElement& element) { return element.name == name; };
  if (std::count_if(elements.begin(), elements.end(), is_named) != 1) {
    const bool has_strips = std::any_of(elements.begin(), elements.end(), [](const auto& element) {
      return element.name == "tristrips";
    });
    throw InputError(file, has_strips ? "strips of triangles ('tristrips') are not read; let a "
                                        "program such as MeshLab save the mesh with faces"
                                      : "the file needs one element " + in_quotes(name) +
                                            ": a link is a surface, not points");
  }
  return *std::find_if(elements.begin(), elements.end(), is_named);
}

PlyHeader read_ply_header(const std::string& file, std::string_view content) {
  return PlyHeaderReader(file, content).read();
}

}  // namespace lockbox
