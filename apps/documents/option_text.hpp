// SPDX-License-Identifier: BSD-3-Clause
// What manual pages and completion of the command line need to know of options.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace lockbox::app {

/// All names, as they are written on the command line: `-m`, `--model`.
std::vector<std::string> names_of(const CLI::Option& option);

/// What its value is called, without the conditions on it: `FILE`. Empty if it takes none.
std::string value_name(const CLI::Option& option);

/// The subcommands, in the order of their declaration.
std::vector<CLI::App*> subcommands_of(CLI::App& options);

}  // namespace lockbox::app
