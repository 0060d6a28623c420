// SPDX-License-Identifier: BSD-3-Clause
#include "option_text.hpp"

namespace lockbox::app {

std::vector<std::string> names_of(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const auto& name : option.get_snames()) names.push_back("-" + name);
  for (const auto& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

std::string value_name(const CLI::Option& option) {
  if (option.get_items_expected_max() == 0) return "";
  const std::string type = option.get_type_name();
  return type.substr(0, type.find(':'));
}

std::vector<CLI::App*> subcommands_of(CLI::App& options) {
  return options.get_subcommands([](const CLI::App*) { return true; });
}

}  // namespace lockbox::app
