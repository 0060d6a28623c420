// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/App.hpp>
#include <string>

namespace lockbox::app {

/// What is wrong with the command line, in a sentence without a full stop. What was mistyped comes
/// first: that an option is missing mostly follows from it.
std::string usage_problem(const CLI::App& options, const CLI::ParseError& error);

/// What is wrong with a key of a file of options, as CLI11 names it in its error.
std::string key_problem(const CLI::App& options, const std::string& key);

/// The option of the command, or of its subcommand that was chosen, with this name, dashes
/// included; null if there is none.
const CLI::Option* option_called(const CLI::App& options, const std::string& name);

}  // namespace lockbox::app
