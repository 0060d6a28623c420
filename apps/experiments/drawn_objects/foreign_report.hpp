// SPDX-License-Identifier: BSD-3-Clause
// Rows and summary of `lockbox experiment furniture` and `boards`.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lockbox/evaluation/figure.hpp"
#include "lockbox/evaluation/foreign_object.hpp"
#include "lockbox/evaluation/table.hpp"

namespace lockbox::app {

std::vector<std::string> foreign_columns();

/// One row a frame of the object.
void add_foreign_rows(Table& table, std::uint64_t piece, const std::string& kind,
                      const ForeignResult& result);

/// Reads the rows of all shards, each frame once, by piece.
Table read_foreign_rows(const std::vector<std::filesystem::path>& files);

/// How many are right, trusted wrongly, left out; what is wrong with which piece.
void print_foreign_report(const std::string& title, const Table& table);

/// Right answers by the number of moving parts, and how many searches took at most so long.
Figure foreign_figure(const std::string& title, const Table& table);

}  // namespace lockbox::app
