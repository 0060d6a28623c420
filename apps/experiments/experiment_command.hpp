// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "command_line/command.hpp"

namespace lockbox::app {

/// The command `experiment`, whose subcommands are the experiments.
std::unique_ptr<Command> make_experiment_command();

}  // namespace lockbox::app
