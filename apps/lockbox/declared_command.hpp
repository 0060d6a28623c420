// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/App.hpp>
#include <memory>

#include "commands.hpp"
#include "option_file.hpp"

namespace lockbox::app {

/// A command with its options, before the command line is read.
struct DeclaredCommand {
  std::unique_ptr<Command> command;
  std::unique_ptr<CLI::App> options;  ///< they write into the command's members
  std::shared_ptr<const OptionFile> option_file;
};

DeclaredCommand declare(const CommandEntry& entry);

}  // namespace lockbox::app
