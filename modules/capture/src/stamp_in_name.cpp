// SPDX-License-Identifier: BSD-3-Clause
#include "stamp_in_name.hpp"

#include <ctime>
#include <regex>

#include "lockbox/core/number_text.hpp"

namespace lockbox {
namespace {

std::optional<double> calendar_stamp(const std::string& stem) {
  static const std::regex pattern(R"((\d{4})(\d\d)(\d\d)T(\d\d)(\d\d)(\d\d(?:\.\d+)?)$)");
  std::smatch match;
  if (!std::regex_search(stem, match, pattern)) {
    return std::nullopt;
  }
  std::tm date{};
  date.tm_year = std::stoi(match[1]) - 1900;
  date.tm_mon = std::stoi(match[2]) - 1;
  date.tm_mday = std::stoi(match[3]);
  date.tm_hour = std::stoi(match[4]);
  date.tm_min = std::stoi(match[5]);
  return static_cast<double>(::timegm(&date)) + *parse_finite_number(match[6].str());
}

}  // namespace

std::optional<double> stamp_in_name(const std::string& stem) {
  if (const std::optional<double> stamp = calendar_stamp(stem)) {
    return stamp;
  }
  const std::size_t before = stem.find_last_not_of("0123456789.");
  const std::string number = before == std::string::npos ? stem : stem.substr(before + 1);
  const std::optional<double> value = parse_finite_number(number);
  if (!value || number.find('.') != std::string::npos) {
    return value;
  }
  if (number.front() == '0') {
    return std::nullopt;  // a count with zeros in front, as KITTI's, or the year 1970
  }
  switch (number.size()) {
    case 10:
      return *value;
    case 13:
      return *value / 1e3;
    case 16:
      return *value / 1e6;
    case 19:
      return *value / 1e9;
    default:
      return std::nullopt;
  }
}

}  // namespace lockbox
