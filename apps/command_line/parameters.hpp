// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "command_line/named_values.hpp"
#include "lockbox/tracking/tracker_options.hpp"

namespace lockbox::app {

/// The options of a command as they are in force, defaults included, by their long names.
NamedValues options_in_force(const CLI::App& options);

/// Every parameter of the tracker.
NamedValues parameters_in_force(const TrackerOptions& options);

/// Sets one of them, given as NAME=VALUE. Throws InputError if there is no such parameter, or the
/// value is none of it.
void set_parameter(const std::string& setting, TrackerOptions& options);

/// The option `--set`, whose settings are added to these.
void add_set_option(CLI::App& options, std::vector<std::string>& settings);

}  // namespace lockbox::app
