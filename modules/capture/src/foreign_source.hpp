// SPDX-License-Identifier: BSD-3-Clause
// Files and folders that people take for sources, and that are something else.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace lockbox {

/// What the file is, by its first bytes, else by its extension, and how to make a source of it;
/// nothing for recordings of OpenNI, and for files that nobody knows.
std::optional<std::string> foreign_file(const std::filesystem::path& file);

/// What a folder without depth.txt and clouds seems to be, and what to do.
std::string foreign_folder(const std::filesystem::path& folder);

}  // namespace lockbox
