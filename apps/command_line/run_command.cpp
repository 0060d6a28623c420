// SPDX-License-Identifier: BSD-3-Clause
#include "run_command.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <new>
#include <optional>
#include <utility>

#include "declared_command.hpp"
#include "interruption.hpp"
#include "lockbox/core/error.hpp"
#include "program.hpp"
#include "usage_problem.hpp"

namespace lockbox::app {
namespace {

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

/// Returns the status of a command that a signal has ended.
ExitStatus signal_status() {
  return static_cast<ExitStatus>(interruption::exit_status(interruption::signal_number()));
}

}  // namespace

ExitStatus run_command(const CommandEntry& entry, std::unique_ptr<Command> command,
                       const std::vector<std::string>& arguments) {
  const DeclaredCommand declared = declare(entry, std::move(command));
  const bool asks_for_help = arguments == std::vector<std::string>{"help"};
  const auto read = asks_for_help ? std::vector<std::string>{"--help"} : arguments;
  try {
    if (const auto status = parse(declared, read)) return *status;
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

}  // namespace lockbox::app
