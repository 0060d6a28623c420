// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/core/readable_text.hpp"

#include <array>
#include <charconv>
#include <cmath>

#include "lockbox/core/number_text.hpp"

namespace lockbox {

std::string readable_number(double value, int digits) {
  constexpr double kLeast = 1e-12;
  constexpr double kMost = 1e18;
  if (std::abs(value) < kLeast) return "0";
  if (!(std::abs(value) < kMost)) return number_text(value);
  std::array<char, 64> text{};
  const auto result = std::to_chars(text.data(), text.data() + text.size(), value,
                                    std::chars_format::scientific, digits - 1);
  const auto rounded = parse_number({text.data(), result.ptr});
  return fixed_number_text(rounded.value_or(value));
}

std::string readable_length(double metres) {
  const double size = std::abs(metres);
  if (size > 0.0 && size < 0.9995e-3) return readable_number(1e6 * metres) + " um";
  if (size > 0.0 && size < 0.9995) return readable_number(1e3 * metres) + " mm";
  return readable_number(metres) + " m";
}

}  // namespace lockbox
