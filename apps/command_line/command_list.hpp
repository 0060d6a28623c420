// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace lockbox::app {

/// What help texts say of a subcommand of `lockbox`.
struct CommandEntry {
  std::string name;
  std::string summary;
  std::string description;  ///< sentences, for the manual page
  std::string example;
};

/// All subcommands, in the order in which help lists them.
const std::vector<CommandEntry>& command_list();

/// The entry of that name, or null.
const CommandEntry* find_command(const std::string& name);

}  // namespace lockbox::app
