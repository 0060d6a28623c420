// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "lockbox/simulation/deviation.hpp"
#include "run_origin.hpp"

namespace lockbox::app {

/// Writes the run.yaml of a simulation whose object is not its model: how it was started, the
/// model's file, the options, and the deviation.
void write_simulation_record(const std::filesystem::path& file, const NamedValues& origin,
                             const std::filesystem::path& model, const NamedValues& options,
                             const Deviation& deviation);

}  // namespace lockbox::app
