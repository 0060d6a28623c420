// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/core/number_text.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace lockbox {

std::optional<double> parse_number(std::string_view text) {
  // from_chars knows no leading plus.
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') {
    text.remove_prefix(1);
  }
  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  if (result.ec != std::errc{} || result.ptr != end) {
    return std::nullopt;
  }
  return value;
}

std::optional<double> parse_finite_number(std::string_view text) {
  const auto value = parse_number(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::string number_text(double value) {
  if (std::isnan(value)) {
    return "nan";  // to_chars would show the sign bit
  }
  std::array<char, 32> text{};
  const auto result = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), result.ptr};
}

std::string fixed_number_text(double value) {
  std::array<char, 400> text{};  // the longest double without exponent has 309 digits
  const auto result =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  return {text.data(), result.ptr};
}

}  // namespace lockbox
