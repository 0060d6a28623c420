// SPDX-License-Identifier: BSD-3-Clause
#include "declared_command.hpp"

#include <CLI/Formatter.hpp>
#include <utility>

#include "lockbox/core/text_file.hpp"

namespace lockbox::app {
namespace {

/// Reads the file before CLI11 does, which reads pipes and devices for ever. Throws InputError.
std::string readable_text(const std::string& file) {
  read_text_file(file, kMostWrittenBytes);
  return {};
}

/// CLI11 names values by types of C++ where nothing else is said.
void name_values(CLI::App& options) {
  for (CLI::Option* option : options.get_options()) {
    const std::string type = option->get_type_name();
    if (type.starts_with("UINT") || type.starts_with("INT")) option->type_name("N");
    if (type.starts_with("FLOAT")) option->type_name("NUMBER");
    if (type.starts_with("TEXT")) option->type_name("NAME");
  }
  for (CLI::App* subcommand : options.get_subcommands([](const CLI::App*) { return true; })) {
    name_values(*subcommand);
  }
}

}  // namespace

DeclaredCommand declare(const CommandEntry& entry, std::unique_ptr<Command> command) {
  auto owned = std::make_unique<CLI::App>(entry.summary, "lockbox " + entry.name);
  CLI::App& options = *owned;
  const auto option_file = std::make_shared<OptionFile>(options);
  options.config_formatter(option_file);
  options.footer("Example:\n  " + entry.example + "\n\n" + kStatusHelp);
  options.set_config("--config", "", "Read options from FILE: lines `name = value`")
      ->check(readable_text)
      ->type_name("FILE");
  options.allow_config_extras(CLI::config_extras_mode::error);
  options.option_defaults()->always_capture_default();
  DeclaredCommand declared{std::move(command), std::move(owned), option_file};
  declared.command->add_options(options);
  name_values(options);
  return declared;
}

}  // namespace lockbox::app
