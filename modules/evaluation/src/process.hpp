// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace lockbox {

enum class ProcessResult { succeeded, failed, not_found };

/// Runs a program found in PATH to its end, with its input and output closed to the null device.
ProcessResult run_quietly(const std::string& program, const std::vector<std::string>& arguments);

}  // namespace lockbox
