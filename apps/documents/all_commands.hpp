// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "command_line/declared_command.hpp"

namespace lockbox::app {

/// A command of the command list with its options, whichever program it is a part of.
DeclaredCommand declare(const CommandEntry& entry);

}  // namespace lockbox::app
