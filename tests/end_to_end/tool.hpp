// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "temporary_folder.hpp"

namespace lockbox {

struct ToolResult {
  int status;  ///< exit status; -signal if a signal ended it
  std::string output;
  std::string errors;
};

/// The lockbox tool, or another program, started with these arguments; standard input is empty.
class Tool {
 public:
  /// environment: additional "NAME=value" entries. output: what standard output goes into; a file
  /// of its own if empty.
  explicit Tool(const std::vector<std::string>& arguments,
                const std::vector<std::string>& environment = {},
                const std::filesystem::path& output = {},
                const std::string& program = LOCKBOX_TOOL);

  /// Waits, at most some seconds, until the signal does what the tool wants it to: while that is
  /// being loaded the system would end it.
  void wait_for_handler(int signal) const;

  /// To the tool and what it has started, as a terminal does.
  void send_signal(int signal) const;

  /// The program that runs in its process by now.
  std::filesystem::path program() const;

  ToolResult wait();

 private:
  TemporaryFolder folder_;  // takes what it prints
  pid_t process_ = -1;
};

ToolResult run_tool(const std::vector<std::string>& arguments,
                    const std::vector<std::string>& environment = {});

std::string read_text(const std::filesystem::path& file);
void write_text(const std::filesystem::path& file, const std::string& text);
std::vector<std::string> read_lines(const std::filesystem::path& file);

/// The rows of states.csv without the latency, which is the clock's.
std::vector<std::string> rows_without_latency(const std::filesystem::path& file);

}  // namespace lockbox
