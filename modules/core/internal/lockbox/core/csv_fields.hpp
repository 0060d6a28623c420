// SPDX-License-Identifier: BSD-3-Clause
// Fields of CSV rows, rows of CSV texts, and words of lines that white space divides.
#pragma once

#include <string_view>
#include <vector>

namespace lockbox {

/// Returns the text without white space at both ends (a carriage return, too).
std::string_view trimmed(std::string_view text);

/// Split at separators, and trimmed; the views point into text.
std::vector<std::string_view> split_fields(std::string_view text, char separator = ',');

/// Split at white space of any length; the views point into text.
std::vector<std::string_view> split_words(std::string_view text);

}  // namespace lockbox
