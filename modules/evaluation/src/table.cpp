// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/table.hpp"

#include <algorithm>
#include <cassert>
#include <fstream>

#include "lockbox/core/csv_file.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/core/number_text.hpp"

namespace lockbox {
namespace {

std::string header(const std::vector<std::string>& columns) {
  std::string line;
  for (const auto& column : columns) line.append(line.empty() ? "" : ",").append(column);
  return line;
}

std::string line_of(const Row& row) {
  std::string line;
  for (const Cell& cell : row) line.append(&cell == &row.front() ? "" : ",").append(cell.text);
  return line;
}

}  // namespace

std::string Cell::number_text(double number) {
  return lockbox::number_text(number);
}

Table::Table(std::vector<std::string> columns) : columns_(std::move(columns)) {}

bool Table::has(const std::string& column) const {
  return std::find(columns_.begin(), columns_.end(), column) != columns_.end();
}

void Table::add(Row row) {
  assert(row.size() == columns_.size());
  rows_.push_back(std::move(row));
}

std::size_t Table::index(const std::string& column) const {
  const auto found = std::find(columns_.begin(), columns_.end(), column);
  assert(found != columns_.end());
  return static_cast<std::size_t>(found - columns_.begin());
}

const std::string& Table::word(const Row& row, const std::string& column) const {
  return row[index(column)].text;
}

double Table::number(const Row& row, const std::string& column) const {
  const auto value = parse_number(word(row, column));
  if (!value)
    throw InputError("column '" + column + "'", "'" + word(row, column) + "' is no number");
  return *value;
}

Table read_table(const std::filesystem::path& file, const std::vector<std::string>& columns) {
  Table table = read_table(file);
  if (table.columns() != columns) {
    throw InputError(file.string(), 1, "is not the header of such results: " + header(columns));
  }
  return table;
}

Table read_table(const std::filesystem::path& file) {
  CsvFile csv(file, UnfinishedRow::left_out);
  Table table({csv.columns().begin(), csv.columns().end()});
  for (CsvRow line; csv.next(line);) {
    Row row;
    for (const auto field : line.fields()) row.emplace_back(std::string(field));
    table.add(std::move(row));
  }
  return table;
}

void write_table(const std::filesystem::path& file, const Table& table) {
  const std::filesystem::path unfinished = file.string() + ".part";
  std::ofstream out(unfinished);
  out << header(table.columns()) << '\n';
  for (const Row& row : table.rows()) out << line_of(row) << '\n';
  out.close();
  if (!out) throw InputError(unfinished.string(), "cannot be written");
  std::filesystem::rename(unfinished, file);
}

void append_row(const std::filesystem::path& file, const Row& row) {
  std::ofstream out(file, std::ios::app);
  out << line_of(row) << '\n';
  out.close();
  if (!out) throw InputError(file.string(), "cannot be written; is there space on the disk?");
}

}  // namespace lockbox
