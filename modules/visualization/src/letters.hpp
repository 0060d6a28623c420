// SPDX-License-Identifier: BSD-3-Clause
// Letters of UTF-8 texts, of which some have several bytes (± and °).
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace lockbox {

inline bool begins_letter(char byte) {
  return (byte & 0xC0) != 0x80;
}

inline std::size_t count_letters(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), begins_letter));
}

/// Returns the text in at most that many letters (three at least), the last of which are points
/// where some are left out.
inline std::string shortened(std::string_view text, std::size_t most) {
  constexpr std::string_view kLeftOut = "...";
  if (count_letters(text) <= most) return std::string(text);
  std::size_t bytes = 0;
  for (std::size_t letters = 0; bytes < text.size(); ++bytes) {
    if (begins_letter(text[bytes]) && letters++ == most - kLeftOut.size()) break;
  }
  return std::string(text.substr(0, bytes)).append(kLeftOut);
}

}  // namespace lockbox
