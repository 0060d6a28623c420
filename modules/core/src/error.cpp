// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/core/error.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

namespace lockbox {
namespace {

/// Bytes of the control character that begins here, which a terminal would obey instead of showing
/// it: one for those of ASCII, two for Unicode's others (0xC2, then 0x80 to 0x9F), 0 if there is
/// none. Line breaks and tabulators are harmless.
std::size_t control_length(std::string_view text) {
  const auto first = static_cast<unsigned char>(text[0]);
  if (first == '\n' || first == '\t') return 0;
  if (first < 0x20 || first == 0x7F) return 1;
  return first == 0xC2 && text.size() > 1 && static_cast<unsigned char>(text[1]) < 0xA0 ? 2 : 0;
}

std::string hexadecimal(char byte) {
  std::array<char, 5> text{};
  std::snprintf(text.data(), text.size(), "\\x%02X",
                static_cast<unsigned int>(static_cast<unsigned char>(byte)));
  return text.data();
}

/// Messages quote files that strangers made. Escape sequences could hide the message, or have the
/// terminal do what its user did not type.
std::string without_controls(std::string_view text) {
  std::string told;
  while (!text.empty()) {
    const std::size_t controls = control_length(text);
    for (const char byte : text.substr(0, controls)) told += hexadecimal(byte);
    if (controls == 0) told += text.front();
    text.remove_prefix(std::max<std::size_t>(controls, 1));
  }
  return told;
}

}  // namespace

InputError::InputError(const std::string& where, const std::string& problem)
    : std::runtime_error(without_controls(where + ": " + problem)) {}

InputError::InputError(const std::string& file, int line, const std::string& problem)
    : InputError(file + ":" + std::to_string(line), problem) {}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kLongest = 120;
  return std::string("'").append(text.substr(0, kLongest)).append("'");
}

}  // namespace lockbox
