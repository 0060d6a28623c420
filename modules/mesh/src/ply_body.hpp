// SPDX-License-Identifier: BSD-3-Clause
// The two encodings of a PLY file's elements, behind one face each: begin_element(), then value()
// or skip() for each value in turn. Both throw InputError with the place in the file.
#pragma once

#include <string>

#include "ply_header.hpp"
#include "tokens.hpp"

namespace lockbox {

/// Each element begins on a line of its own, and may go on over several.
class TextPlyBody {
 public:
  TextPlyBody(const std::string& file, const PlyHeader& header);

  /// Bytes that such an element takes at least: each of its words and the blank behind it.
  static std::size_t least_bytes(const PlyElement& element);

  void begin_element();
  double value(PlyType type);
  void skip(PlyType type, std::size_t count);
  [[noreturn]] void refuse(const std::string& problem) const;

 private:
  std::string_view next_word();

  std::string file_;
  Lines lines_;
  int header_lines_;
  std::string_view rest_;  ///< of the line
};

class BinaryPlyBody {
 public:
  BinaryPlyBody(const std::string& file, const PlyHeader& header);

  static std::size_t least_bytes(const PlyElement& element);

  void begin_element() {}
  double value(PlyType type);
  void skip(PlyType type, std::size_t count);
  [[noreturn]] void refuse(const std::string& problem) const;

 private:
  /// Removes so many bytes from the rest, and returns what was the rest before.
  std::string_view take(std::size_t bytes);

  std::string file_;
  std::endian order_;
  std::string_view whole_;
  std::string_view rest_;
};

}  // namespace lockbox
