// SPDX-License-Identifier: BSD-3-Clause
#include "printable_text.hpp"

#include <array>
#include <cstddef>
#include <cstdio>

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

/// Returns the length of the character that the text begins with; 0 if it is none, or is cut off.
std::size_t printable_length(std::string_view text) {
  const std::size_t length = character_length(static_cast<unsigned char>(text.front()));
  if (length > text.size()) return 0;
  for (std::size_t k = 1; k < length; ++k) {
    if ((static_cast<unsigned char>(text[k]) & 0xC0) != 0x80) return 0;
  }
  return length;
}

}  // namespace

std::optional<std::string> unprintable_byte(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = printable_length(text);
    if (length == 0) {
      std::array<char, 5> hexadecimal{};
      std::snprintf(hexadecimal.data(), hexadecimal.size(), "0x%02X",
                    static_cast<unsigned int>(static_cast<unsigned char>(text.front())));
      return hexadecimal.data();
    }
    text.remove_prefix(length);
  }
  return std::nullopt;
}

}  // namespace lockbox
