// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/App.hpp>
#include <memory>

#include "command.hpp"
#include "command_list.hpp"
#include "option_file.hpp"

namespace lockbox::app {

/// A command with its options, before the command line is read.
struct DeclaredCommand {
  std::unique_ptr<Command> command;
  std::unique_ptr<CLI::App> options;  ///< they write into the command's members
  std::shared_ptr<const OptionFile> option_file;
};

/// Declares the options of a command, and those that all commands have.
DeclaredCommand declare(const CommandEntry& entry, std::unique_ptr<Command> command);

}  // namespace lockbox::app
