// SPDX-License-Identifier: BSD-3-Clause
// Raw results of an experiment: rows under named columns, as CSV. Tables with the same columns may
// be concatenated, and one that is written row by row can be continued after an interruption.
#pragma once

#include <filesystem>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace lockbox {

/// A number in its shortest text that reads back the same, or a word without commas.
struct Cell {
  std::string text;

  Cell(std::string word) : text(std::move(word)) {}
  Cell(const char* word) : text(word) {}
  template <typename Number, typename = std::enable_if_t<std::is_arithmetic_v<Number>>>
  Cell(Number number) : text(number_text(static_cast<double>(number))) {}

  static std::string number_text(double number);
};

using Row = std::vector<Cell>;

class Table {
 public:
  explicit Table(std::vector<std::string> columns);

  const std::vector<Row>& rows() const { return rows_; }
  const std::vector<std::string>& columns() const { return columns_; }

  /// One cell a column.
  void add(Row row);

  bool has(const std::string& column) const;

  /// The column must exist. number() throws InputError if the cell holds none.
  const std::string& word(const Row& row, const std::string& column) const;
  double number(const Row& row, const std::string& column) const;

 private:
  std::size_t index(const std::string& column) const;

  std::vector<std::string> columns_;
  std::vector<Row> rows_;
};

/// Reads a table with these columns. A last row without its end is left out. Throws InputError with
/// file and line.
Table read_table(const std::filesystem::path& file, const std::vector<std::string>& columns);

/// Likewise, with whatever columns it has.
Table read_table(const std::filesystem::path& file);

/// Replaces the file at once, so that it is complete whatever ends the program. Throws InputError
/// if it cannot be written.
void write_table(const std::filesystem::path& file, const Table& table);

/// Adds one row at the end of a file that write_table made.
void append_row(const std::filesystem::path& file, const Row& row);

}  // namespace lockbox
