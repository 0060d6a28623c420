// SPDX-License-Identifier: BSD-3-Clause
#include "output_paths.hpp"

#include "lockbox/core/error.hpp"

namespace lockbox::app {

namespace fs = std::filesystem;

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError(folder.string(), "cannot be made a folder: " + error.message());
}

void make_folder_of(const fs::path& file) {
  if (file.has_parent_path()) make_folder(file.parent_path());
}

void require_different(const fs::path& output, const fs::path& input) {
  std::error_code is_missing;
  if (fs::equivalent(output, input, is_missing)) {
    throw InputError(output.string(), "is read, so it cannot be written; choose another name");
  }
}

void require_new(const fs::path& file, bool overwrite) {
  std::error_code unreadable;
  if (overwrite || !fs::exists(file, unreadable)) return;
  throw InputError(file.string(), "exists already; choose another name, or give --overwrite");
}

}  // namespace lockbox::app
