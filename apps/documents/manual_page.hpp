// SPDX-License-Identifier: BSD-3-Clause
// Manual pages in the language of man(7), made of the same declarations as the help texts.
#pragma once

#include <ostream>

#include "command_line/command_list.hpp"

namespace lockbox::app {

/// lockbox(1): what the commands are for.
void write_overview_page(std::ostream& out);

/// lockbox-NAME(1): the options of one command, and of its subcommands.
void write_manual_page(std::ostream& out, const CommandEntry& entry);

}  // namespace lockbox::app
