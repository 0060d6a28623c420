// SPDX-License-Identifier: BSD-3-Clause
// What all programs do alike before and after their own work.
#pragma once

#include <string>
#include <vector>

#include "command.hpp"

namespace lockbox::app {

/// Calls `run` with the arguments, the program's name left out. Returns the status of the process:
/// that of `run`, or of invalid_input if standard output could not be written.
int run_program(int argc, char** argv, ExitStatus (*run)(const std::vector<std::string>&));

/// Says the message on standard error, and returns the status.
ExitStatus fail(ExitStatus status, const std::string& message);

}  // namespace lockbox::app
