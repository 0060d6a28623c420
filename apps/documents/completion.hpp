// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>

namespace lockbox::app {

/// A script for bash that completes commands, options, and the values of those that take files,
/// folders or names, made of the same declarations as the help texts.
void write_bash_completion(std::ostream& out);

}  // namespace lockbox::app
