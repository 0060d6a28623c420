// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace lockbox::app {

/// Makes the folder, and those above it, unless they exist. Throws InputError.
void make_folder(const std::filesystem::path& folder);

/// Makes the folder that a file shall be in.
void make_folder_of(const std::filesystem::path& file);

/// Throws InputError if both are names of one file, so that writing would destroy what is read.
void require_different(const std::filesystem::path& output, const std::filesystem::path& input);

/// Throws InputError if the file exists, unless it is to be overwritten.
void require_new(const std::filesystem::path& file, bool overwrite);

}  // namespace lockbox::app
