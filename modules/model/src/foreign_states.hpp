// SPDX-License-Identifier: BSD-3-Clause
// Files that hold no states, given as one that does.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace lockbox {

/// "is <what>, not a states file; <what to do>", by the file's first bytes, its first numbers, or
/// its extension; nothing if it may be one that lacks a column. lines: those of the file.
std::optional<std::string> foreign_states(const std::filesystem::path& file,
                                          std::span<const std::string_view> lines);

}  // namespace lockbox
