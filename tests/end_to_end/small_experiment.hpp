// SPDX-License-Identifier: BSD-3-Clause
// The smallest version of an experiment, and the rows that it writes.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace lockbox {

/// A row of a table by the names of its columns.
using NamedRow = std::map<std::string, std::string>;

std::vector<NamedRow> read_rows(const std::filesystem::path& file);

double number(const NamedRow& row, const std::string& column);

/// Runs `lockbox experiment NAME`, and expects it to end well. Returns what it prints.
std::string run_experiment(const std::string& name, const std::string& model,
                           const std::filesystem::path& output,
                           const std::vector<std::string>& options);

}  // namespace lockbox
