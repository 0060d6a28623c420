// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace lockbox {

/// Whether the bytes are UTF-8 without control characters. (urdfdom's XML parser trusts the length
/// that the first byte of a character announces.)
bool is_printable_text(std::string_view text);

}  // namespace lockbox
