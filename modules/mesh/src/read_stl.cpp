// SPDX-License-Identifier: BSD-3-Clause
#include <cctype>
#include <cstdint>

#include "binary_number.hpp"
#include "lockbox/core/error.hpp"
#include "mesh_readers.hpp"
#include "tokens.hpp"

namespace lockbox {
namespace {

constexpr std::size_t kHeaderBytes = 84;
constexpr std::size_t kTriangleBytes = 50;
constexpr std::size_t kNormalBytes = 12;

/// Whether the lower-case keyword is this word, which some programs write in capitals.
bool is_keyword(std::string_view word, std::string_view keyword) {
  return std::equal(word.begin(), word.end(), keyword.begin(), keyword.end(), [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) == b;
  });
}

/// Follows solids, facets and vertices; all else (normals, loops, names, colours) has no say.
class TextStlReader {
 public:
  TextStlReader(const std::filesystem::path& file, std::string_view content)
      : soup_(file.string()), lines_(content) {}

  PolygonSoup read() {
    while (lines_.next()) {
      line(lines_.text());
    }
    if (is_in_solid_ || is_in_facet_) {
      refuse("the file ends before 'endsolid': it is truncated");
    }
    if (!was_solid_) {
      throw InputError(soup_.file(), "not an STL file: it has neither a solid nor a binary header");
    }
    return std::move(soup_);
  }

 private:
  void line(std::string_view rest) {
    for (auto word = take_word(rest); !word.empty(); word = take_word(rest)) {
      if (is_keyword(word, "end")) {
        end_of(take_word(rest), rest);
      } else if (word.size() > 3 && is_keyword(word.substr(0, 3), "end")) {
        end_of(word.substr(3), rest);
      } else if (is_keyword(word, "solid")) {
        is_in_solid_ = was_solid_ = true;
        rest = {};  // its name, which may be any words
      } else if (is_keyword(word, "facet")) {
        begin_facet();
      } else if (is_keyword(word, "vertex")) {
        vertex(rest);
      }
    }
  }

  void end_of(std::string_view what, std::string_view& rest) {
    if (is_keyword(what, "solid")) {
      is_in_solid_ = false;
      rest = {};
    } else if (is_keyword(what, "facet")) {
      end_facet();
    }
  }

  void begin_facet() {
    if (is_in_facet_) refuse("the facet before has no 'endfacet'");
    is_in_facet_ = true;
    corners_ = 0;
  }

  void vertex(std::string_view& rest) {
    if (!is_in_facet_) refuse("a vertex stands outside of a facet");
    Eigen::Vector3d position;
    for (double& coordinate : position) {
      const std::string_view word = take_word(rest);
      if (word.empty()) refuse("expected three numbers after 'vertex'");
      coordinate = finite_number(word, soup_.file(), lines_.number());
    }
    soup_.add_corner(static_cast<std::uint32_t>(soup_.vertices().size()));
    soup_.add_vertex(position);
    ++corners_;
  }

  void end_facet() {
    if (!is_in_facet_ || corners_ != 3) {
      refuse("a facet has " + std::to_string(is_in_facet_ ? corners_ : 0) +
             " vertices instead of 3");
    }
    soup_.end_face();
    is_in_facet_ = false;
  }

  [[noreturn]] void refuse(const std::string& problem) const {
    throw InputError(soup_.file(), lines_.number(), problem);
  }

  PolygonSoup soup_;
  Lines lines_;
  bool was_solid_ = false;
  bool is_in_solid_ = false;
  bool is_in_facet_ = false;
  int corners_ = 0;
};

PolygonSoup read_binary(const std::filesystem::path& file, std::string_view content) {
  PolygonSoup soup(file.string());
  if (content.size() < kHeaderBytes) {
    throw InputError(soup.file(), "not an STL file: too short for a header");
  }
  const auto count = binary_number<std::uint32_t>(content.substr(80), std::endian::little);
  // Some programs append data of their own.
  if (content.size() < kHeaderBytes + kTriangleBytes * std::size_t{count}) {
    throw InputError(soup.file(), "a binary STL file with " + std::to_string(count) +
                                      " triangles would be larger: it is truncated or garbled");
  }
  for (std::uint32_t t = 0; t < count; ++t) {
    std::string_view triangle = content.substr(kHeaderBytes + kTriangleBytes * t, kTriangleBytes);
    triangle.remove_prefix(kNormalBytes);
    for (std::uint32_t i = 0; i < 3; ++i) {
      Eigen::Vector3d position;
      for (double& coordinate : position) {
        coordinate = static_cast<double>(binary_number<float>(triangle, std::endian::little));
        triangle.remove_prefix(sizeof(float));
      }
      if (!position.allFinite()) {
        throw InputError(soup.file(), "a corner of triangle " + std::to_string(t + 1) +
                                          " is not finite: the file is garbled");
      }
      soup.add_corner(3 * t + i);
      soup.add_vertex(position);
    }
    soup.end_face();
  }
  return soup;
}

}  // namespace

PolygonSoup read_stl(const std::filesystem::path& file, std::string_view content) {
  // Binary files may begin with "solid", too. But they hold a zero early: the last byte of a count
  // below 16 million, if not before.
  const bool is_binary = content.substr(0, kHeaderBytes).find('\0') != std::string_view::npos;
  return is_binary ? read_binary(file, content) : TextStlReader(file, content).read();
}

}  // namespace lockbox
