// SPDX-License-Identifier: BSD-3-Clause
// Numbers as text, in the C locale whatever the user's locale is.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace lockbox {

/// The number that the whole text spells, nan and inf included; nothing if it spells none.
std::optional<double> parse_number(std::string_view text);

/// The shortest text that parse_number turns into the same value.
std::string number_text(double value);

}  // namespace lockbox
