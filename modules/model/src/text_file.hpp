// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace lockbox {

/// The bytes of a regular file. Throws InputError if there is none, if it is larger than 512 MB, or
/// if it cannot be read.
std::string read_text_file(const std::filesystem::path& file);

}  // namespace lockbox
