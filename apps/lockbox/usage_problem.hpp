// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/App.hpp>
#include <string>

namespace lockbox::app {

/// What is wrong with the command line, in a sentence without a full stop. What was mistyped comes
/// first: that an option is missing mostly follows from it.
std::string usage_problem(const CLI::App& options, const CLI::ParseError& error);

/// The same for a file of options.
std::string configuration_problem(const CLI::App& options, const CLI::ConfigError& error);

}  // namespace lockbox::app
