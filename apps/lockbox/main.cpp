// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/App.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "declared_command.hpp"
#include "documents.hpp"
#include "interruption.hpp"
#include "lockbox/core/error.hpp"
#include "nearest_name.hpp"
#include "usage_problem.hpp"
#include "version.hpp"

namespace lockbox::app {
namespace {

void print_overview(std::ostream& out) {
  out << "lockbox " << kVersion << ": tracks articulated objects with a depth camera\n\n"
      << "Usage: lockbox COMMAND [OPTIONS]\n\nCommands:\n";
  for (const auto& entry : commands()) {
    out << "  " << entry.name << std::string(12 - entry.name.size(), ' ') << entry.summary << '\n';
  }
  out << "\n`lockbox COMMAND --help` (or `lockbox help COMMAND`) explains the options of a "
         "command, with an example.\n";
}

ExitStatus fail(ExitStatus status, const std::string& message) {
  std::cerr << "lockbox: " << message << '\n';
  return status;
}

/// Reads the options; returns nothing if the command shall run. Throws InputError.
std::optional<ExitStatus> parse(const DeclaredCommand& declared,
                                std::vector<std::string> arguments) {
  CLI::App& options = *declared.options;
  try {
    std::reverse(arguments.begin(), arguments.end());  // as CLI11 wants them
    options.parse(std::move(arguments));
    return std::nullopt;
  } catch (const CLI::Success& request) {  // --help
    options.exit(request);
    return ExitStatus::done;
  } catch (const CLI::FileError&) {
    const auto file = options.get_config_ptr()->as<std::string>();
    return fail(
        ExitStatus::invalid_input,
        "--config " + file +
            (std::filesystem::exists(file) ? ": cannot be read" : ": there is no such file"));
  } catch (const CLI::ConfigError& error) {
    return fail(ExitStatus::invalid_input, declared.option_file->problem(error));
  } catch (const CLI::ParseError& error) {
    const std::string problem = usage_problem(options, error);
    const auto place = declared.option_file->place_of_option_in(problem);
    if (place) return fail(ExitStatus::invalid_input, *place + ": " + problem);
    return fail(ExitStatus::wrong_usage, problem + "\nSee `" + options.get_name() + " --help`.");
  }
}

/// What cannot be had. The standard library does not name the folder for temporary files.
std::string name_of(const std::filesystem::filesystem_error& error) {
  if (!error.path1().empty()) return error.path1().string();
  const char* const folder = std::getenv("TMPDIR");
  return std::string("the folder for temporary files (TMPDIR=") + (folder ? folder : "") + ")";
}

/// Of a command that a signal has ended.
ExitStatus signal_status() {
  return static_cast<ExitStatus>(interruption::exit_status(interruption::signal_number()));
}

ExitStatus run(const CommandEntry& entry, const std::vector<std::string>& arguments) {
  const DeclaredCommand declared = declare(entry);
  try {
    if (const auto status = parse(declared, arguments)) return *status;
    const EndAtSignal end_at_signal;
    const ExitStatus status = declared.command->run();
    return interruption::requested() ? signal_status() : status;
  } catch (const InputError& error) {
    const auto place = declared.option_file->place_of_value_in(error.what());
    return fail(ExitStatus::invalid_input,
                error.what() + (place ? " (given in " + *place + ")" : std::string()));
  } catch (const DeviceError& error) {
    return fail(ExitStatus::device_failed, error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    return fail(ExitStatus::invalid_input, name_of(error) + ": " + error.code().message());
  } catch (const std::bad_alloc&) {
    return fail(ExitStatus::internal_error, "not enough memory");
  } catch (const std::exception& error) {
    return fail(ExitStatus::internal_error, std::string("internal error: ") + error.what());
  }
}

/// Nobody has read what a full disk has swallowed. That a pipe was closed, its signal tells.
ExitStatus require_output(ExitStatus status) {
  if (std::cout.flush() || status == ExitStatus::pipe_closed) return status;
  return fail(ExitStatus::invalid_input, "standard output cannot be written; is the disk full?");
}

bool asks_for_help(const std::string& argument) {
  return argument == "--help" || argument == "-h" || argument == "help";
}

ExitStatus refuse_command(const std::string& name) {
  if (!name.empty()) {
    std::vector<std::string> names;
    for (const auto& entry : commands()) names.push_back(entry.name);
    std::cerr << "lockbox: there is no command '" << name << "'" << did_you_mean(name, names)
              << "\n\n";
  }
  print_overview(std::cerr);
  return ExitStatus::wrong_usage;
}

/// For the build, which installs them: `lockbox --documents FOLDER`.
ExitStatus write_documents_into(const std::vector<std::string>& folders) {
  if (folders.size() != 1) return fail(ExitStatus::wrong_usage, "--documents needs one FOLDER");
  try {
    write_documents(folders.front());
    return ExitStatus::done;
  } catch (const std::exception& error) {
    return fail(ExitStatus::invalid_input, folders.front() + ": " + error.what());
  }
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
  if (name == "--documents") return write_documents_into(options);
  if (name == "--version") {
    std::cout << "lockbox " << kVersion << '\n';
    return ExitStatus::done;
  }
  if (options == std::vector<std::string>{"help"}) options.front() = "--help";
  for (const auto& entry : commands()) {
    if (entry.name == name) return run(entry, options);
  }
  return refuse_command(name);
}

}  // namespace
}  // namespace lockbox::app

int main(int argc, char** argv) {
  using namespace lockbox::app;
  std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);  // whoever reads a pipe sees each line at once
  return static_cast<int>(require_output(dispatch({argv + std::min(argc, 1), argv + argc})));
}
