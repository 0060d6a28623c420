// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "command_line/command.hpp"

namespace lockbox::app {

/// Becomes the program of that name beside this one, in the same process: signals reach it, and its
/// status is that of the process. Returns only where it cannot be started, and has said so then.
ExitStatus become_program(const std::string& name, const std::vector<std::string>& arguments);

}  // namespace lockbox::app
