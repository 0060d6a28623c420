// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <cstring>

#include "file_checks.hpp"
#include "lockbox/core/error.hpp"
#include "tokens.hpp"

namespace lockbox {
namespace {

constexpr std::size_t kHeaderBytes = 84;
constexpr std::size_t kTriangleBytes = 50;

std::uint32_t binary_count(const std::string& content) {
  std::uint32_t count = 0;
  std::memcpy(&count, content.data() + kHeaderBytes - sizeof count, sizeof count);
  return count;
}

/// Follows the grammar: facet normal, outer loop, three vertices, endloop, endfacet.
std::size_t check_text(const std::string& file, const std::string& content) {
  std::size_t facets = 0;
  int vertices = 0;
  bool is_ended = false;
  Lines lines(content);
  while (lines.next()) {
    const auto words = words_of(lines.text());
    if (words.empty()) {
      continue;
    }
    is_ended = words[0] == "endsolid";
    if (words[0] == "vertex") {
      ++vertices;
      const bool is_point = words.size() == 4 && is_finite_number(words[1]) &&
                            is_finite_number(words[2]) && is_finite_number(words[3]);
      if (!is_point) {
        throw InputError(file, lines.number(), "expected three finite numbers after 'vertex'");
      }
    } else if (words[0] == "endfacet") {
      if (vertices != 3) {
        throw InputError(file, lines.number(),
                         "a facet has " + std::to_string(vertices) + " vertices instead of 3");
      }
      vertices = 0;
      ++facets;
    } else if (words[0] != "solid" && words[0] != "facet" && words[0] != "outer" &&
               words[0] != "endloop" && !is_ended) {
      throw InputError(file, lines.number(),
                       "unexpected " + in_quotes(words[0]) + " in an STL file");
    }
  }
  if (!is_ended) {
    throw InputError(file, lines.number(), "the file ends before 'endsolid': it is truncated");
  }
  return facets;
}

}  // namespace

std::size_t check_stl(const std::filesystem::path& file, const std::string& content) {
  // Some binary files start with "solid" too: the size tells.
  if (content.size() >= kHeaderBytes &&
      content.size() == kHeaderBytes + kTriangleBytes * std::size_t{binary_count(content)}) {
    return binary_count(content);
  }
  const std::size_t begin = content.find_first_not_of(" \t\r\n");
  if (begin != std::string::npos && content.compare(begin, 5, "solid") == 0) {
    return check_text(file.string(), content);
  }
  if (content.size() < kHeaderBytes) {
    throw InputError(file.string(), "not an STL file: too short for a header");
  }
  throw InputError(file.string(), "a binary STL file with " +
                                      std::to_string(binary_count(content)) +
                                      " triangles has another size: it is truncated or garbled");
}

}  // namespace lockbox
