// SPDX-License-Identifier: BSD-3-Clause
#include "printable_text.hpp"

#include <cstddef>

namespace lockbox {
namespace {

/// Bytes of the UTF-8 character that begins with this byte; 0 if none does.
std::size_t character_length(unsigned char first) {
  if (first < 0x20 || first == 0x7F) return 0;  // control characters
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first < 0xE0) return 2;
  if (first >= 0xE0 && first < 0xF0) return 3;
  if (first >= 0xF0 && first < 0xF5) return 4;
  return 0;
}

}  // namespace

bool is_printable_text(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = character_length(static_cast<unsigned char>(text[i]));
    if (length == 0 || i + length > text.size()) return false;
    for (std::size_t k = 1; k < length; ++k) {
      if ((static_cast<unsigned char>(text[i + k]) & 0xC0) != 0x80) return false;
    }
    i += length;
  }
  return true;
}

}  // namespace lockbox
