// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "commands.hpp"
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
  out << "\n`lockbox COMMAND --help` explains the options of a command, with an example.\n";
}

ExitStatus fail(ExitStatus status, const std::string& message) {
  std::cerr << "lockbox: " << message << '\n';
  return status;
}

/// Reads the options; returns nothing if the command shall run.
std::optional<ExitStatus> parse(CLI::App& options, std::span<char*> arguments) {
  try {
    options.parse(static_cast<int>(arguments.size()), arguments.data());
    return std::nullopt;
  } catch (const CLI::Success& request) {  // --help
    options.exit(request);
    return ExitStatus::done;
  } catch (const CLI::FileError& error) {
    return fail(ExitStatus::invalid_input, std::string("--config: ") + error.what());
  } catch (const CLI::ConfigError& error) {
    return fail(ExitStatus::invalid_input, options.get_config_ptr()->as<std::string>() + ": " +
                                               configuration_problem(options, error));
  } catch (const CLI::ParseError& error) {
    return fail(ExitStatus::wrong_usage,
                usage_problem(options, error) + "\nSee `" + options.get_name() + " --help`.");
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

ExitStatus run(const CommandEntry& entry, std::span<char*> arguments) {
  const auto command = entry.make();
  CLI::App options(entry.summary, "lockbox " + entry.name);
  options.footer("Example:\n  " + entry.example + "\n\n" + kStatusHelp);
  options.set_config("--config", "", "Read options from FILE: lines `name = value`")
      ->type_name("FILE");
  options.allow_config_extras(CLI::config_extras_mode::error);
  options.option_defaults()->always_capture_default();
  command->add_options(options);
  if (const auto status = parse(options, arguments)) return *status;
  const EndAtSignal end_at_signal;
  try {
    const ExitStatus status = command->run();
    return interruption::requested() ? signal_status() : status;
  } catch (const InputError& error) {
    return fail(ExitStatus::invalid_input, error.what());
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

ExitStatus dispatch(std::span<char*> arguments) {
  const std::string name = arguments.size() > 1 ? arguments[1] : "";
  if (name == "--help" || name == "-h" || name == "help") {
    print_overview(std::cout);
    return ExitStatus::done;
  }
  if (name == "--version") {
    std::cout << "lockbox " << kVersion << '\n';
    return ExitStatus::done;
  }
  for (const auto& entry : commands()) {
    if (entry.name == name) return run(entry, arguments.subspan(1));
  }
  if (!name.empty()) {
    std::vector<std::string> names;
    for (const auto& entry : commands()) names.push_back(entry.name);
    std::cerr << "lockbox: there is no command '" << name << "'" << did_you_mean(name, names)
              << "\n\n";
  }
  print_overview(std::cerr);
  return ExitStatus::wrong_usage;
}

}  // namespace
}  // namespace lockbox::app

int main(int argc, char** argv) {
  using namespace lockbox::app;
  std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);  // whoever reads a pipe sees each line at once
  return static_cast<int>(require_output(dispatch({argv, static_cast<std::size_t>(argc)})));
}
