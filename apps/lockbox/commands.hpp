// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "command_line/command.hpp"

namespace lockbox::app {

/// The command of that name in the command list; not `experiment`, which is a program of its own.
std::unique_ptr<Command> make_command(const std::string& name);

// One source each: <name>_command.cpp.
std::unique_ptr<Command> make_track_command();
std::unique_ptr<Command> make_simulate_command();
std::unique_ptr<Command> make_record_command();
std::unique_ptr<Command> make_evaluate_command();
std::unique_ptr<Command> make_inspect_command();
std::unique_ptr<Command> make_view_command();
std::unique_ptr<Command> make_cache_command();
std::unique_ptr<Command> make_devices_command();

}  // namespace lockbox::app
