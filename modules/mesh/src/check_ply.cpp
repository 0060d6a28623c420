// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <string_view>
#include <vector>

#include "file_checks.hpp"
#include "lockbox/core/error.hpp"
#include "tokens.hpp"

namespace lockbox {
namespace {

/// Bytes of a PLY type, 0 for an unknown one.
std::size_t bytes_of(std::string_view type) {
  static const std::map<std::string_view, std::size_t> kBytes = {
      {"char", 1},  {"uchar", 1},   {"int8", 1},   {"uint8", 1},  {"short", 2}, {"ushort", 2},
      {"int16", 2}, {"uint16", 2},  {"int", 4},    {"uint", 4},   {"int32", 4}, {"uint32", 4},
      {"float", 4}, {"float32", 4}, {"double", 8}, {"float64", 8}};
  const auto found = kBytes.find(type);
  return found == kBytes.end() ? 0 : found->second;
}

struct Property {
  std::string_view name;
  std::size_t bytes;        ///< of the value, or of each value of the list
  std::size_t count_bytes;  ///< of the list's length; 0 if it is no list
};

bool is_vertex_list(const Property& property) {
  return property.count_bytes != 0 &&
         (property.name == "vertex_indices" || property.name == "vertex_index");
}

struct Element {
  std::string_view name;
  std::size_t count;
  std::vector<Property> properties;
};

enum class Encoding { text, little_endian, big_endian };

struct Header {
  Encoding encoding = Encoding::text;
  std::vector<Element> elements;
  std::string_view body;
  int lines = 0;

  /// The only element of this name; throws InputError if there is none, or more.
  const Element& only(std::string_view name, const std::string& file) const {
    const auto is_named = [&](const Element& element) { return element.name == name; };
    if (std::count_if(elements.begin(), elements.end(), is_named) != 1) {
      throw InputError(file, "the file needs one element " + in_quotes(name) +
                                 ": a link is a surface, not points");
    }
    return *std::find_if(elements.begin(), elements.end(), is_named);
  }
};

/// VTK's reader keeps a list's length in a byte.
constexpr std::size_t kLongestList = 255;

class HeaderReader {
 public:
  HeaderReader(const std::string& file, const std::string& content)
      : file_(file), lines_(content) {}

  Header read() {
    if (!lines_.next() || words_of(lines_.text()) != std::vector<std::string_view>{"ply"}) {
      refuse("not a PLY file: the first line is not 'ply'");
    }
    Header header;
    while (lines_.next()) {
      const auto words = words_of(lines_.text());
      if (words.empty() || words[0] == "comment" || words[0] == "obj_info") {
        continue;
      }
      if (words[0] == "end_header") {
        header.body = lines_.rest();
        header.lines = lines_.number();
        return header;
      }
      entry(words, header);
    }
    refuse("the header has no end: the file is truncated");
  }

 private:
  void entry(const std::vector<std::string_view>& words, Header& header) const {
    if (words[0] == "format" && words.size() == 3) {
      header.encoding = encoding(words[1]);
    } else if (words[0] == "element" && words.size() == 3) {
      header.elements.push_back({words[1], count(words[2]), {}});
    } else if (words[0] == "property" && !header.elements.empty()) {
      header.elements.back().properties.push_back(property(words));
    } else {
      refuse(in_quotes(lines_.text()) + " does not belong in a header");
    }
  }

  Encoding encoding(std::string_view name) const {
    if (name == "ascii") {
      return Encoding::text;
    }
    if (name == "binary_little_endian") {
      return Encoding::little_endian;
    }
    if (name == "binary_big_endian") {
      return Encoding::big_endian;
    }
    refuse("unknown format " + in_quotes(name));
  }

  std::size_t count(std::string_view word) const {
    std::uint32_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size()) {
      refuse(in_quotes(word) + " is not a number of elements");
    }
    return value;
  }

  Property property(const std::vector<std::string_view>& words) const {
    const bool is_list = words.size() == 5 && words[1] == "list";
    if (!is_list && words.size() != 3) {
      refuse("a property needs a type and a name");
    }
    const Property result{words.back(), bytes_of(words[is_list ? 3 : 1]),
                          is_list ? bytes_of(words[2]) : 0};
    const auto is_fraction = [](std::string_view type) { return type[0] == 'f' || type[0] == 'd'; };
    const bool has_fractions =
        is_list && (is_fraction(words[2]) || (is_vertex_list(result) && is_fraction(words[3])));
    if (result.bytes == 0 || (is_list && result.count_bytes == 0) || has_fractions) {
      refuse("unknown type in " + in_quotes(lines_.text()));
    }
    return result;
  }

  [[noreturn]] void refuse(const std::string& problem) const {
    throw InputError(file_, std::max(lines_.number(), 1), problem);
  }

  const std::string& file_;
  Lines lines_;
};

/// Indices are compared as unsigned numbers: negative ones become too large.
void require_vertex(std::size_t index, const Header& header, const std::string& file) {
  if (index >= header.only("vertex", file).count) {
    throw InputError(file, "a face refers to a vertex that does not exist");
  }
}

/// An unsigned number of up to eight bytes.
std::size_t read_unsigned(std::string_view bytes, Encoding encoding) {
  std::size_t value = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const std::size_t at = encoding == Encoding::big_endian ? i : bytes.size() - 1 - i;
    value = 256 * value + static_cast<unsigned char>(bytes[at]);
  }
  return value;
}

void check_binary_body(const std::string& file, const Header& header) {
  std::string_view rest = header.body;
  const auto skip = [&](std::size_t bytes) {
    if (bytes > rest.size()) {
      throw InputError(file, "the file ends before its last element: it is truncated or garbled");
    }
    rest.remove_prefix(bytes);
  };
  for (const Element& element : header.elements) {
    for (std::size_t i = 0; i < element.count; ++i) {
      for (const Property& property : element.properties) {
        if (property.count_bytes == 0) {
          skip(property.bytes);
          continue;
        }
        const std::size_t length =
            read_unsigned(rest.substr(0, property.count_bytes), header.encoding);
        if (length > kLongestList) {
          throw InputError(file, "a list has " + std::to_string(length) +
                                     " entries, more than 255: the file is garbled");
        }
        skip(property.count_bytes);
        for (std::size_t entry = 0; entry < length; ++entry) {
          const std::string_view bytes = rest.substr(0, property.bytes);
          skip(property.bytes);
          if (is_vertex_list(property)) {
            require_vertex(read_unsigned(bytes, header.encoding), header, file);
          }
        }
      }
    }
  }
}

/// The word as an unsigned number; the largest there is if it is none.
std::size_t parse_unsigned(std::string_view word) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  const bool is_number = error == std::errc() && end == word.data() + word.size();
  return is_number ? value : std::numeric_limits<std::size_t>::max();
}

void check_text_line(const std::string& file, int number, const Header& header,
                     const Element& element, const std::vector<std::string_view>& words) {
  std::size_t expected = 0;
  for (const Property& property : element.properties) {
    const std::size_t first = expected + 1;
    const bool is_list = property.count_bytes != 0 && expected < words.size();
    const std::size_t length = is_list ? parse_unsigned(words[expected]) : 0;
    expected = first + std::min(length, kLongestList);
    for (std::size_t i = first; is_vertex_list(property) && i < expected && i < words.size(); ++i) {
      require_vertex(parse_unsigned(words[i]), header, file + ":" + std::to_string(number));
    }
  }
  if (words.size() != expected || !std::all_of(words.begin(), words.end(), is_finite_number)) {
    throw InputError(file, number,
                     "expected " + std::to_string(expected) + " finite numbers for element " +
                         in_quotes(element.name));
  }
}

void check_text_body(const std::string& file, const Header& header) {
  Lines lines(header.body);
  for (const Element& element : header.elements) {
    for (std::size_t i = 0; i < element.count; ++i) {
      do {
        if (!lines.next()) {
          throw InputError(file, "the file ends before its last element: it is truncated");
        }
      } while (words_of(lines.text()).empty());
      check_text_line(file, header.lines + lines.number(), header, element, words_of(lines.text()));
    }
  }
}

/// The reader takes what it expects to be there without looking.
void check_elements(const std::string& file, const Header& header) {
  const auto has = [](const Element& element, std::string_view name, bool is_list) {
    return 1 == std::count_if(element.properties.begin(), element.properties.end(),
                              [&](const Property& property) {
                                return property.name == name &&
                                       (property.count_bytes != 0) == is_list;
                              });
  };
  const Element& vertex = header.only("vertex", file);
  if (!has(vertex, "x", false) || !has(vertex, "y", false) || !has(vertex, "z", false)) {
    throw InputError(file, "the vertices have no properties 'x', 'y' and 'z'");
  }
  const Element& face = header.only("face", file);
  if (has(face, "vertex_indices", true) == has(face, "vertex_index", true)) {
    throw InputError(file, "the faces have no list 'vertex_indices'");
  }
}

}  // namespace

std::size_t check_ply(const std::filesystem::path& file, const std::string& content) {
  const std::string name = file.string();
  const Header header = HeaderReader(name, content).read();
  check_elements(name, header);
  if (header.encoding == Encoding::text) {
    check_text_body(name, header);
  } else {
    check_binary_body(name, header);
  }
  return header.only("face", name).count;
}

}  // namespace lockbox
