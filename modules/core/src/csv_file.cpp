// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/core/csv_file.hpp"

#include <algorithm>

#include "lockbox/core/csv_fields.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/core/number_text.hpp"
#include "lockbox/core/text_file.hpp"

namespace lockbox {

double CsvRow::number(std::size_t column) const {
  const auto value = parse_number(fields_[column]);
  if (!value) refuse(column, in_quotes(fields_[column]) + " is no number");
  return *value;
}

void CsvRow::refuse(const std::string& problem) const {
  throw InputError(file_->name(), line_, problem);
}

void CsvRow::refuse(std::size_t column, const std::string& problem) const {
  refuse("column '" + std::string(file_->columns()[column]) + "': " + problem);
}

CsvFile::CsvFile(const std::filesystem::path& file, UnfinishedRow last)
    : name_(file.string()), text_(read_text_file(file)) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  std::string_view content = text_;
  if (content.starts_with(kByteOrderMark)) content.remove_prefix(kByteOrderMark.size());
  lines_ = split_fields(content, '\n');
  while (header_ + 1 < lines_.size() && lines_[header_].starts_with('#')) ++header_;
  next_ = header_ + 1;
  columns_ = split_fields(lines_[header_]);
  if (last == UnfinishedRow::left_out && lines_.size() > next_) lines_.pop_back();
}

std::optional<std::size_t> CsvFile::column(std::string_view name) const {
  const auto found = std::find(columns_.begin(), columns_.end(), name);
  if (found == columns_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns_.begin());
}

void CsvFile::require_header(std::string_view header, const std::string& what) const {
  if (columns_ == split_fields(header)) return;
  refuse_header("is not the header of " + what + ": " + std::string(header));
}

void CsvFile::refuse_header(const std::string& problem) const {
  throw InputError(name_, static_cast<int>(header_) + 1, problem);
}

bool CsvFile::next(CsvRow& row) {
  while (next_ < lines_.size() && lines_[next_].empty()) ++next_;
  if (next_ >= lines_.size()) return false;
  row.file_ = this;
  row.line_ = static_cast<int>(next_) + 1;
  row.fields_ = split_fields(lines_[next_++]);
  if (row.fields_.size() != columns_.size()) {
    row.refuse("has " + std::to_string(row.fields_.size()) + " fields, the header " +
               std::to_string(columns_.size()) + "; is the line cut off?");
  }
  return true;
}

}  // namespace lockbox
