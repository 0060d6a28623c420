// SPDX-License-Identifier: BSD-3-Clause
// Files of comma-separated values: comments (#), a header, and rows of as many fields.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lockbox {

/// A last row without a line break at its end: it may be one that was being written when the
/// program ended.
enum class UnfinishedRow { read, left_out };

class CsvFile;

/// A row, which refers to its file. What is wrong with it is said as an InputError with file and
/// line.
class CsvRow {
 public:
  /// Returns the fields, trimmed, as many as the header has.
  const std::vector<std::string_view>& fields() const { return fields_; }
  std::string_view field(std::size_t column) const { return fields_[column]; }

  /// Refuses what is no number; nan and inf are numbers.
  double number(std::size_t column) const;

  [[noreturn]] void refuse(const std::string& problem) const;

  /// Names the column, too.
  [[noreturn]] void refuse(std::size_t column, const std::string& problem) const;

 private:
  friend class CsvFile;

  const CsvFile* file_ = nullptr;
  int line_ = 0;
  std::vector<std::string_view> fields_;
};

class CsvFile {
 public:
  /// Reads all of it. A byte order mark is passed over. Throws InputError if it cannot be read.
  explicit CsvFile(const std::filesystem::path& file, UnfinishedRow last = UnfinishedRow::read);
  CsvFile(const CsvFile&) = delete;
  CsvFile& operator=(const CsvFile&) = delete;

  const std::string& name() const { return name_; }

  /// Refuses the header, or what is said in it.
  [[noreturn]] void refuse_header(const std::string& problem) const;

  /// Returns the columns of the header, trimmed.
  const std::vector<std::string_view>& columns() const { return columns_; }

  /// Where the column of that name is; nothing if there is none.
  std::optional<std::size_t> column(std::string_view name) const;

  /// Refuses another header than this one. what: the file should hold, as in "results".
  void require_header(std::string_view header, const std::string& what) const;

  /// All lines, trimmed, comments included.
  const std::vector<std::string_view>& lines() const { return lines_; }

  /// The next row that is not empty; false after the last. Refuses one with more or fewer fields
  /// than the header has.
  bool next(CsvRow& row);

 private:
  std::string name_;
  std::string text_;
  std::vector<std::string_view> lines_;
  std::vector<std::string_view> columns_;
  std::size_t header_ = 0;  ///< index of its line
  std::size_t next_ = 1;    ///< index of a line
};

}  // namespace lockbox
