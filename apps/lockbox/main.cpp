// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>
#include <string>
#include <vector>

#include "called_program.hpp"
#include "command_line/nearest_name.hpp"
#include "command_line/program.hpp"
#include "command_line/run_command.hpp"
#include "command_line/shipped_files.hpp"
#include "command_line/version.hpp"
#include "commands.hpp"

namespace lockbox::app {
namespace {

void print_overview(std::ostream& out) {
  out << "lockbox " << kVersion << ": tracks articulated objects with a depth camera\n\n"
      << "Usage: lockbox COMMAND [OPTIONS]\n\nCommands:\n";
  for (const auto& entry : command_list()) {
    out << "  " << entry.name << std::string(12 - entry.name.size(), ' ') << entry.summary << '\n';
  }
  out << "\n`lockbox COMMAND --help` (or `lockbox help COMMAND`) explains the options of a "
         "command, with an example.\n";
  const auto documents = shipped_documents();
  if (!documents.empty()) out << "Tutorial, how-tos and reference: " << documents.string() << '\n';
}

bool asks_for_help(const std::string& argument) {
  return argument == "--help" || argument == "-h" || argument == "help";
}

ExitStatus refuse_command(const std::string& name) {
  if (!name.empty()) {
    std::vector<std::string> names;
    for (const auto& entry : command_list()) names.push_back(entry.name);
    std::cerr << "lockbox: there is no command '" << name << "'" << did_you_mean(name, names)
              << "\n\n";
  }
  print_overview(std::cerr);
  return ExitStatus::wrong_usage;
}

/// `lockbox track ...`; `lockbox help track` and `lockbox track help` mean `lockbox track --help`.
ExitStatus dispatch(const std::vector<std::string>& arguments) {
  std::string name = arguments.empty() ? "" : arguments.front();
  std::vector<std::string> options(arguments.begin() + (arguments.empty() ? 0 : 1),
                                   arguments.end());
  if (asks_for_help(name)) {
    if (options.empty()) {
      print_overview(std::cout);
      return ExitStatus::done;
    }
    name = options.front();
    options.front() = "--help";
  }
  if (name == "--version") {
    std::cout << "lockbox " << kVersion << '\n';
    return ExitStatus::done;
  }
  if (name == "experiment") return become_program("lockbox-experiment", options);
  const CommandEntry* const entry = find_command(name);
  return entry != nullptr ? run_command(*entry, make_command(name), options) : refuse_command(name);
}

}  // namespace
}  // namespace lockbox::app

int main(int argc, char** argv) {
  return lockbox::app::run_program(argc, argv, lockbox::app::dispatch);
}
