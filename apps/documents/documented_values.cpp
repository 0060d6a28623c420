// SPDX-License-Identifier: BSD-3-Clause
#include "documented_values.hpp"

#include <fstream>
#include <optional>
#include <regex>

#include "lockbox/core/error.hpp"

namespace lockbox::app {
namespace {

/// Takes `Unit: metres.` out of a comment: up to the full stop that ends the sentence.
std::string take(const std::string& mark, std::string& comment) {
  const std::size_t begin = comment.find(mark + ": ");
  if (begin == std::string::npos) return "";
  const std::size_t value = begin + mark.size() + 2;
  const std::size_t stop = comment.find(". ", value);
  const std::size_t end = stop == std::string::npos ? comment.size() : stop + 2;
  std::string sentence = comment.substr(value, end - value);
  comment.erase(begin, end - begin);
  sentence.erase(sentence.find_last_not_of(". ") + 1);
  return sentence;
}

/// What `std::numeric_limits<double>::infinity()` and `CollisionMode::eroded` are to a reader.
std::string readable(const std::string& value) {
  if (value.empty()) return "empty";
  if (value.ends_with("infinity()")) return "inf";
  const std::size_t scope = value.rfind("::");
  return scope == std::string::npos ? value : value.substr(scope + 2);
}

/// `  double gate = 4.0;` or `inline constexpr double kLine = 10.0;`. Others hold values
/// themselves, or functions.
std::optional<DocumentedValue> declared_value(const std::string& line) {
  static const std::regex declaration(
      R"((?:  |inline constexpr )((?:std::)?[a-z_]\w*(?:<\w+>)?|\w+)\s(\w+)(?: = (.+))?;)");
  std::smatch match;
  if (!std::regex_match(line, match, declaration) || match[3] == "nullptr") return std::nullopt;
  const bool is_aggregate = !match[3].matched && std::isupper(match[1].str().front()) != 0;
  if (is_aggregate) return std::nullopt;
  return DocumentedValue{match[2], readable(match[3]), "", "", ""};
}

}  // namespace

std::vector<DocumentedValue> read_documented_values(const std::filesystem::path& header) {
  static const std::regex comment_line(R"(\s*/// (.*))");
  std::ifstream file(header);
  if (!file) throw InputError(header.string(), "cannot be read");
  std::vector<DocumentedValue> values;
  std::string comment;
  std::string common_source;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    std::smatch match;
    if (std::regex_match(line, match, comment_line)) {
      comment += (comment.empty() ? "" : " ") + match[1].str();
      continue;
    }
    if (line.starts_with("struct ")) common_source = take("Source", comment);
    if (auto value = declared_value(line)) {
      if (comment.empty())
        throw InputError(header.string(), number, value->name + " has no comment");
      value->unit = take("Unit", comment);
      value->source = take("Source", comment);
      if (value->source.empty()) value->source = common_source;
      comment.erase(comment.find_last_not_of(' ') + 1);
      value->effect = comment;
      values.push_back(*value);
    }
    comment.clear();
  }
  return values;
}

}  // namespace lockbox::app
