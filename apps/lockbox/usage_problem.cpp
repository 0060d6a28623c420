// SPDX-License-Identifier: BSD-3-Clause
#include "usage_problem.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "lockbox/core/error.hpp"
#include "nearest_name.hpp"

namespace lockbox::app {
namespace {

bool is_option(const std::string& argument) {
  return argument.size() > 1 && argument.front() == '-';
}

void append_long_names(const CLI::App& options, std::vector<std::string>& names) {
  for (const CLI::Option* option : options.get_options()) {
    const auto& own = option->get_lnames();
    names.insert(names.end(), own.begin(), own.end());
  }
}

/// Of the command and of its subcommand that was chosen, without dashes.
std::vector<std::string> long_names(const CLI::App& options) {
  std::vector<std::string> names;
  append_long_names(options, names);
  for (const CLI::App* chosen : options.get_subcommands()) append_long_names(*chosen, names);
  return names;
}

std::string unknown_option(const CLI::App& options, const std::string& argument) {
  const std::string name = argument.substr(0, argument.find('='));
  const auto meant = nearest_name(name.substr(name.find_first_not_of('-')), long_names(options));
  return "there is no option " + name + (meant ? "; did you mean --" + *meant + "?" : "");
}

std::string unknown_subcommand(const std::string& argument,
                               const std::vector<const CLI::App*>& subcommands) {
  std::vector<std::string> names;
  std::string list;
  for (const CLI::App* subcommand : subcommands) {
    names.push_back(subcommand->get_name());
    list.append(list.empty() ? "" : ", ").append(names.back());
  }
  return in_quotes(argument) + " is none of " + list + did_you_mean(argument, names);
}

/// A value without its option: that of the first which is missing, probably.
std::string stray_value(const CLI::App& options, const std::string& argument) {
  const std::string problem = in_quotes(argument) + " belongs to no option";
  for (const CLI::Option* option : options.get_options()) {
    if (option->get_required() && option->count() == 0) {
      return problem + "; did you mean --" + option->get_lnames().front() + ' ' + argument + '?';
    }
  }
  return problem;
}

std::string unexpected(const CLI::App& options, const std::string& argument) {
  if (is_option(argument)) return unknown_option(options, argument);
  const auto subcommands = options.get_subcommands([](const CLI::App*) { return true; });
  if (!subcommands.empty() && options.get_subcommands().empty()) {
    return unknown_subcommand(argument, subcommands);
  }
  return stray_value(options, argument);
}

}  // namespace

std::string usage_problem(const CLI::App& options, const CLI::ParseError& error) {
  constexpr bool kOfSubcommandsToo = true;
  const auto unused = options.remaining(kOfSubcommandsToo);
  if (unused.empty()) return error.what();
  const auto option = std::find_if(unused.begin(), unused.end(), is_option);
  return unexpected(options, option != unused.end() ? *option : unused.front());
}

std::string configuration_problem(const CLI::App& options, const CLI::ConfigError& error) {
  const std::string problem = error.what();
  const std::string last_word = problem.substr(problem.rfind(' ') + 1);
  return "keys are the long names of this command's options; " + problem +
         did_you_mean(last_word, long_names(options));
}

}  // namespace lockbox::app
