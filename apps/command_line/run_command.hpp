// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "command.hpp"
#include "command_list.hpp"

namespace lockbox::app {

/// Reads the options of a command and runs it. Says on standard error what is wrong with them, or
/// why the command has failed. `help` alone means --help.
ExitStatus run_command(const CommandEntry& entry, std::unique_ptr<Command> command,
                       const std::vector<std::string>& arguments);

}  // namespace lockbox::app
