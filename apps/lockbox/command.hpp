// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/App.hpp>

namespace lockbox::app {

/// What the process returns; part of the tool's interface.
enum class ExitStatus : int {
  done = 0,
  lost = 1,           ///< done, but the last status was `lost`
  wrong_usage = 2,    ///< unknown option, missing or malformed value
  invalid_input = 3,  ///< an input is missing or invalid, or an output cannot be written
  device_failed = 4,
  internal_error = 70,  ///< a defect of the program (EX_SOFTWARE of sysexits.h)
};

class Command {
 public:
  virtual ~Command() = default;

  /// Declares options that write into the command's members.
  virtual void add_options(CLI::App& options) = 0;

  /// Called after the options were read. Throws InputError or DeviceError.
  virtual ExitStatus run() = 0;
};

}  // namespace lockbox::app
