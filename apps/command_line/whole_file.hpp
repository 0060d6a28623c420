// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace lockbox::app {

/// Replaces the file by this text at once: never half a file, even if the process ends here. Throws
/// InputError if it cannot be written.
void write_whole_file(const std::filesystem::path& file, const std::string& text);

}  // namespace lockbox::app
