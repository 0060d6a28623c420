// SPDX-License-Identifier: BSD-3-Clause
#include "csv_fields.hpp"

namespace lockbox {

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string_view> split_fields(std::string_view text) {
  std::vector<std::string_view> fields;
  for (auto comma = text.find(','); comma != std::string_view::npos; comma = text.find(',')) {
    fields.push_back(trimmed(text.substr(0, comma)));
    text.remove_prefix(comma + 1);
  }
  fields.push_back(trimmed(text));
  return fields;
}

}  // namespace lockbox
