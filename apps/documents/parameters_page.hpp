// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <ostream>

namespace lockbox::app {

/// docs/parameters.md: the options of `lockbox track`, the parameters of the tracker and the
/// quantities that evidence depends on, in Markdown. They are read from the declarations of the
/// options, and from the headers below this folder, that of the sources. Throws InputError.
void write_parameters_page(std::ostream& out, const std::filesystem::path& sources);

}  // namespace lockbox::app
