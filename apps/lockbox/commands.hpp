// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "command.hpp"

namespace lockbox::app {

struct CommandEntry {
  std::string name;
  std::string summary;
  std::string example;
  std::unique_ptr<Command> (*make)();
};

/// All subcommands, in the order in which help lists them.
const std::vector<CommandEntry>& commands();

// One source each: <name>_command.cpp.
std::unique_ptr<Command> make_track_command();
std::unique_ptr<Command> make_simulate_command();
std::unique_ptr<Command> make_record_command();
std::unique_ptr<Command> make_evaluate_command();
std::unique_ptr<Command> make_experiment_command();
std::unique_ptr<Command> make_inspect_command();
std::unique_ptr<Command> make_view_command();
std::unique_ptr<Command> make_cache_command();
std::unique_ptr<Command> make_devices_command();

}  // namespace lockbox::app
