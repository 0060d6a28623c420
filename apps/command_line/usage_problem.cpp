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

/// Returns the names of the command and of its subcommand that was chosen, without dashes.
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

/// `problem` is what CLI11 says: "--model: 1 required FILE missing", "--model: At Most 1 ...".
std::string wrong_count(const CLI::App& options, const std::string& problem) {
  const std::string name = problem.substr(0, problem.find(':'));
  const CLI::Option* const option = option_called(options, name);
  if (option == nullptr) return problem;
  if (problem.find("received") != std::string::npos) return name + " can be given only once";
  const std::string type = option->get_type_name();
  return name + " needs a value" + (type.empty() ? "" : ": " + name + ' ' + type);
}

/// "Could not convert: --seed = 1.5".
std::string wrong_kind(const CLI::App& options, const std::string& problem) {
  const std::size_t colon = problem.find(": ");
  const std::size_t equals = problem.find(" = ");
  if (colon == std::string::npos || equals == std::string::npos) return problem;
  const std::string name = problem.substr(colon + 2, equals - colon - 2);
  const std::string value = problem.substr(equals + 3);
  const CLI::Option* const option = option_called(options, name);
  if (option == nullptr) return problem;
  const bool is_flag = option->get_expected_max() == 0;
  return name + ": " + in_quotes(value) +
         (is_flag ? " is neither true nor false" : " is not a whole number, or too large");
}

/// "--deviation excludes --bounds".
std::string wrong_pair(const std::string& problem) {
  const std::string verb = " excludes ";
  const std::size_t at = problem.find(verb);
  if (at == std::string::npos) return problem;
  return problem.substr(0, at) + " and " + problem.substr(at + verb.size()) +
         " cannot be given together";
}

}  // namespace

const CLI::Option* option_called(const CLI::App& options, const std::string& name) {
  const CLI::Option* option = options.get_option_no_throw(name);
  for (const CLI::App* chosen : options.get_subcommands()) {
    if (option == nullptr) option = chosen->get_option_no_throw(name);
  }
  return option;
}

std::string usage_problem(const CLI::App& options, const CLI::ParseError& error) {
  constexpr bool kOfSubcommandsToo = true;
  const auto unused = options.remaining(kOfSubcommandsToo);
  if (unused.empty()) {
    const std::string problem = error.what();
    if (error.get_name() == "ArgumentMismatch") return wrong_count(options, problem);
    if (error.get_name() == "ConversionError") return wrong_kind(options, problem);
    if (error.get_name() == "ExcludesError") return wrong_pair(problem);
    return problem;
  }
  const auto option = std::find_if(unused.begin(), unused.end(), is_option);
  return unexpected(options, option != unused.end() ? *option : unused.front());
}

std::string key_problem(const CLI::App& options, const std::string& key) {
  if (key.ends_with("++") || key.ends_with("--") || key.starts_with('[')) {
    return "[sections] are not read; give the options of one command as lines `name = value`";
  }
  if (option_called(options, "--" + key) != nullptr) {
    return "--" + key + " belongs on the command line";
  }
  return "there is no option " + in_quotes(key) +
         "; keys are the long names of this command's options, without dashes" +
         did_you_mean(key, long_names(options));
}

}  // namespace lockbox::app
