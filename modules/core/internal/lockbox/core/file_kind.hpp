// SPDX-License-Identifier: BSD-3-Clause
// What a file that was given in the wrong place is: known by its first bytes, else by its name.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace lockbox {

struct FileKind {
  std::string_view magic;       ///< first bytes; empty: only the extension tells
  std::string_view extensions;  ///< in lower case with their dots, each with a blank behind it
  const char* what;             ///< with its article: "a recording of OpenNI"
  const char* advice;           ///< how to use or to convert it
};

/// The file's first 16 bytes, or fewer; none if it cannot be read.
std::string first_bytes(const std::filesystem::path& file);

/// Returns the extension with its dot, in lower case.
std::string lower_extension(const std::filesystem::path& file);

/// The first kind that the bytes begin as, else the first that the name ends as; null if none is.
const FileKind* find_kind(const std::filesystem::path& file, std::span<const FileKind> kinds);

}  // namespace lockbox
