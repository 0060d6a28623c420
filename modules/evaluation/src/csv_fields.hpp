// SPDX-License-Identifier: BSD-3-Clause
// Fields of CSV rows, in the C locale whatever the user's locale.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lockbox {

/// Without white space at both ends (a carriage return, too).
std::string_view trimmed(std::string_view text);

/// Cut at commas; the views point into text.
std::vector<std::string_view> split_fields(std::string_view text);

/// The number that the whole field holds, `nan` and `inf` included.
std::optional<double> parse_field(std::string_view field);

/// Shortest text that reads back to the same number; `nan`, `inf`.
std::string field_text(double value);

}  // namespace lockbox
