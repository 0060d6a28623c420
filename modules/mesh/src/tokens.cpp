// SPDX-License-Identifier: BSD-3-Clause
#include "tokens.hpp"

#include <algorithm>

#include "lockbox/core/error.hpp"
#include "lockbox/core/number_text.hpp"

namespace lockbox {

Lines::Lines(std::string_view content) : rest_(content) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (rest_.starts_with(kByteOrderMark)) rest_.remove_prefix(kByteOrderMark.size());
}

bool Lines::next() {
  if (rest_.empty()) {
    return false;
  }
  const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
  text_ = rest_.substr(0, end);
  rest_.remove_prefix(end);
  rest_.remove_prefix(rest_.starts_with("\r\n") ? 2 : std::min<std::size_t>(1, rest_.size()));
  ++number_;
  return true;
}

std::string_view take_word(std::string_view& line) {
  constexpr std::string_view kBlanks = " \t\r\f\v";
  line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(kBlanks));
  line.remove_prefix(word.size());
  return word;
}

double finite_number(std::string_view word, const std::string& file, int line) {
  const auto value = parse_finite_number(word);
  if (!value) {
    const bool has_comma = word.find(',') != std::string_view::npos;
    throw InputError(file, line,
                     in_quotes(word) + " is not a finite number" +
                         (has_comma ? "; write decimals with a point, not with a comma" : ""));
  }
  return *value;
}

}  // namespace lockbox
