// SPDX-License-Identifier: BSD-3-Clause
// What stands under a path. Of a path that cannot be looked up (a name longer than file systems
// take, a folder that is closed) the standard library's functions of one argument throw; to readers
// of files, whose names strangers chose, nothing stands there.
#pragma once

#include <filesystem>
#include <system_error>

namespace lockbox {

inline bool is_there(const std::filesystem::path& path) {
  std::error_code unknown;
  return std::filesystem::exists(path, unknown);
}

inline bool is_file(const std::filesystem::path& path) {
  std::error_code unknown;
  return std::filesystem::is_regular_file(path, unknown);
}

inline bool is_folder(const std::filesystem::path& path) {
  std::error_code unknown;
  return std::filesystem::is_directory(path, unknown);
}

}  // namespace lockbox
