// SPDX-License-Identifier: BSD-3-Clause
#include "number.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace lockbox {

std::optional<double> parse_number(std::string_view text) {
  if (!text.empty() && text.front() == '+') {
    text.remove_prefix(1);
  }
  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

std::string format_number(double value) {
  std::array<char, 400> buffer;  // the longest double without exponent has 309 digits
  const auto [stop, error] =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed);
  return error == std::errc{} ? std::string(buffer.data(), stop) : std::to_string(value);
}

}  // namespace lockbox
