// SPDX-License-Identifier: BSD-3-Clause
// Numbers in text files: the C locale, whatever the user's locale is.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace lockbox {

/// The finite number that the whole text spells, or nothing.
std::optional<double> parse_number(std::string_view text);

/// The shortest decimal, without exponent, that parse_number turns into the same double.
std::string format_number(double value);

}  // namespace lockbox
