// SPDX-License-Identifier: BSD-3-Clause
// Fields of CSV rows.
#pragma once

#include <string_view>
#include <vector>

namespace lockbox {

/// Without white space at both ends (a carriage return, too).
std::string_view trimmed(std::string_view text);

/// Cut at commas; the views point into text.
std::vector<std::string_view> split_fields(std::string_view text);

}  // namespace lockbox
