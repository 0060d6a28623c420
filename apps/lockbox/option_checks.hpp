// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/App.hpp>

namespace lockbox::app {

/// Refuse values of options with a message that says what they must be.
CLI::Validator positive();
CLI::Validator not_negative();
CLI::Validator recording_name();  ///< ends in .oni, or no source would know it again

}  // namespace lockbox::app
