// SPDX-License-Identifier: BSD-3-Clause
// Numbers as text, in the C locale whatever the user's locale is.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace lockbox {

/// The number that the whole text spells, nan and inf included, with or without a leading plus;
/// nothing if it spells none.
std::optional<double> parse_number(std::string_view text);

/// Reads a number likewise, but neither nan nor inf.
std::optional<double> parse_finite_number(std::string_view text);

/// The shortest text that parse_number turns into the same value.
std::string number_text(double value);

/// The shortest such text without an exponent, for readers that know none.
std::string fixed_number_text(double value);

}  // namespace lockbox
