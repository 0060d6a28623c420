// SPDX-License-Identifier: BSD-3-Clause
// Long lists of runs, spread over processes or machines.
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "lockbox/evaluation/table.hpp"

namespace lockbox::app {

/// One of `count` equal parts of a list.
class Shard {
 public:
  /// Adds `--shard i/n`, and reads it.
  void add_to(CLI::App& options);

  bool holds(std::uint64_t run) const { return run % count_ == index_ - 1; }
  std::uint64_t runs_of(std::uint64_t total) const { return (total + count_ - index_) / count_; }

  /// Where this part's rows belong: <stem>.csv, or <stem>_shard1of4.csv.
  std::filesystem::path rows_file(const std::filesystem::path& stem) const;

 private:
  /// Throws CLI::ValidationError if the text is no shard.
  void parse(const std::string& text);

  std::uint64_t index_ = 1;
  std::uint64_t count_ = 1;
};

/// The rows that an earlier run has left in the file, or none if there is no such file.
Table continued_table(const std::filesystem::path& file, const std::vector<std::string>& columns);

/// The files with rows of any shard of this stem.
std::vector<std::filesystem::path> rows_files(const std::filesystem::path& stem);

}  // namespace lockbox::app
