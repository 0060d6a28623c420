// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace lockbox::app {

/// Writes the manual pages and the completion of the command line into this folder, laid out as
/// `share` of an installation is: `man/man1/*.1`, `bash-completion/completions/lockbox`. Throws
/// InputError or std::filesystem::filesystem_error if they cannot be written.
void write_documents(const std::filesystem::path& share);

}  // namespace lockbox::app
