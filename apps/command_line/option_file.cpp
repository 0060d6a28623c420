// SPDX-License-Identifier: BSD-3-Clause
#include "option_file.hpp"

#include <algorithm>
#include <iterator>
#include <sstream>

#include "lockbox/core/error.hpp"
#include "usage_problem.hpp"

namespace lockbox::app {
namespace {

/// Returns the key of a line `key = value`, as CLI11 takes it.
std::string key_of(const std::string& line) {
  std::string key = line.substr(0, std::min(line.find('='), line.find('#')));
  CLI::detail::trim(key);
  CLI::detail::remove_quotes(key);
  return key;
}

/// Messages, file names and what the system is told end at a zero.
bool holds_zero(const std::string& line) {
  return line.find('\0') != std::string::npos;
}

/// Throws InputError if a line is no text.
std::map<std::string, int> lines_of_keys(const std::string& text, const std::string& file) {
  std::map<std::string, int> lines;
  std::istringstream rest(text);
  std::string line;
  for (int number = 1; std::getline(rest, line); ++number) {
    if (holds_zero(line))
      throw InputError(file, number, "is no text: it holds a byte that is zero");
    lines.emplace(key_of(line), number);
  }
  lines.erase("");  // of comments
  return lines;
}

/// CLI11 takes short names, too.
const CLI::Option* option_of_key(const CLI::App& options, const std::string& key) {
  return option_called(options, (key.size() == 1 ? "-" : "--") + key);
}

/// Whether the message is about this value: "VALUE: there is no such file", "sensor 'VALUE': ...".
bool speaks_of(const std::string& message, const std::string& value) {
  return !value.empty() &&
         (message.starts_with(value + ":") || message.find(in_quotes(value)) != std::string::npos);
}

}  // namespace

std::vector<CLI::ConfigItem> OptionFile::from_config(std::istream& input) const {
  const std::string text{std::istreambuf_iterator<char>(input), {}};
  lines_ = lines_of_keys(text, options_.get_config_ptr()->as<std::string>());
  std::istringstream again(text);
  auto read = ConfigBase::from_config(again);
  for (const auto& item : read) {
    const CLI::Option* const option = option_of_key(options_, item.name);
    if (option != nullptr && option->empty()) given_.insert(option);
  }
  return read;
}

std::string OptionFile::to_flag(const CLI::ConfigItem& item) const {
  if (item.inputs.size() == 1) return item.inputs.front();
  throw CLI::ConversionError("--" + item.name, item.inputs);
}

std::string OptionFile::problem(const CLI::ConfigError& error) const {
  // "INI was not able to parse KEY", or "KEY: This option is not allowed in a configuration file".
  const std::string unknown = "INI was not able to parse ";
  const std::string text = error.what();
  const std::string key = text.starts_with(unknown) ? text.substr(unknown.size())
                                                    : text.substr(0, text.rfind(": This option"));
  return place_of_key(key) + ": " + key_problem(options_, key);
}

std::string OptionFile::place_of_key(const std::string& key) const {
  const auto file = options_.get_config_ptr()->as<std::string>();
  const auto line = lines_.find(key);
  return line == lines_.end() ? file : file + ":" + std::to_string(line->second);
}

std::optional<std::string> OptionFile::place_of(const CLI::Option& option) const {
  if (!given_.contains(&option)) return std::nullopt;
  for (const auto& names : {option.get_lnames(), option.get_snames()}) {
    for (const auto& name : names) {
      if (lines_.contains(name)) return place_of_key(name);
    }
  }
  return place_of_key("");
}

std::optional<std::string> OptionFile::place_of_option_in(const std::string& problem) const {
  std::istringstream words(problem);
  for (std::string word; words >> word;) {
    if (!word.starts_with('-')) continue;
    const CLI::Option* const option = option_called(options_, word.substr(0, word.find(':')));
    const auto place = option != nullptr ? place_of(*option) : std::nullopt;
    if (place) return place;
  }
  return std::nullopt;
}

std::optional<std::string> OptionFile::place_of_value_in(const std::string& message) const {
  for (const CLI::Option* option : given_) {
    const auto& values = option->results();
    const bool is_meant = std::any_of(values.begin(), values.end(), [&](const std::string& value) {
      return speaks_of(message, value);
    });
    if (is_meant) return place_of(*option);
  }
  return std::nullopt;
}

}  // namespace lockbox::app
