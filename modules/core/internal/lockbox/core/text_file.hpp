// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace lockbox {

inline constexpr std::uintmax_t kMostTextBytes =
    512'000'000;  ///< eighteen hours of states, at 30 Hz
inline constexpr std::uintmax_t kMostWrittenBytes = 4'000'000;  ///< more than people write by hand

/// The bytes of a regular file. Throws InputError if there is none (a device or a pipe could
/// deliver for ever), if it is larger than most_bytes, or if it cannot be read.
std::string read_text_file(const std::filesystem::path& file,
                           std::uintmax_t most_bytes = kMostTextBytes);

}  // namespace lockbox
