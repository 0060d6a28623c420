// SPDX-License-Identifier: BSD-3-Clause
// Rows and table of `lockbox experiment mismatch`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "lockbox/evaluation/mismatch.hpp"
#include "lockbox/evaluation/table.hpp"

namespace lockbox::app {

/// Returns those of deviation_kinds(), and the sensors `stereo` and `time-of-flight`.
const std::vector<std::string>& mismatch_kinds();

std::vector<std::string> mismatch_columns();

/// One row a frame.
void add_mismatch_rows(Table& table, const std::string& kind, std::uint64_t seed,
                       const std::vector<MismatchFrame>& frames);

/// One line a kind, over all seeds; errors are those of frames that are called tracking.
void print_mismatch_report(const std::string& title,
                           const std::vector<std::filesystem::path>& files);

}  // namespace lockbox::app
