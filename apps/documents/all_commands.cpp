// SPDX-License-Identifier: BSD-3-Clause
#include "all_commands.hpp"

#include "../lockbox/commands.hpp"
#include "experiments/experiment_command.hpp"

namespace lockbox::app {

DeclaredCommand declare(const CommandEntry& entry) {
  return declare(entry,
                 entry.name == "experiment" ? make_experiment_command() : make_command(entry.name));
}

}  // namespace lockbox::app
