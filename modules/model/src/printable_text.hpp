// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace lockbox {

/// Where the text stops to be UTF-8 without control characters: the byte as messages tell it, such
/// as 0x0A. Nothing if it is such text to its end. (urdfdom's XML parser trusts the length that the
/// first byte of a character announces.)
std::optional<std::string> unprintable_byte(std::string_view text);

}  // namespace lockbox
