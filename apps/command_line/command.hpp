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
  never_tracked = 5,    ///< done, but the status was `tracking` in no frame
  internal_error = 70,  ///< a defect of the program (EX_SOFTWARE of sysexits.h)
  // Ended by a signal, output complete: 128 and its number, as shells say it.
  hung_up = 129,
  interrupted = 130,
  pipe_closed = 141,
  terminated = 143,
};

/// The same, for help texts.
inline constexpr auto kStatusHelp =
    "Exit status: 0 done; 2 wrong usage; 3 an input is missing or invalid, or an output cannot be "
    "written; 4 the device failed; 129, 130, 141, 143 ended by SIGHUP, SIGINT (Ctrl-C), SIGPIPE, "
    "SIGTERM, what is written being complete; 70 an error of the program";
inline constexpr auto kTrackStatusHelp =
    "Also 1: done, but the last status was `lost`; 5: done, but no frame was ever `tracking`";

class Command {
 public:
  virtual ~Command() = default;

  /// Declares options that write into the command's members.
  virtual void add_options(CLI::App& options) = 0;

  /// Called after the options were read. Throws InputError or DeviceError.
  virtual ExitStatus run() = 0;
};

}  // namespace lockbox::app
