// SPDX-License-Identifier: BSD-3-Clause
#include "run_origin.hpp"

#include <sys/utsname.h>

#include <array>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <fstream>

namespace lockbox::app {
namespace {

std::string quoted_for_shell(const std::string& argument) {
  constexpr auto kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789%+,-./:=@_";
  if (!argument.empty() && argument.find_first_not_of(kPlain) == std::string::npos) {
    return argument;
  }
  std::string quoted = "'";
  for (const char c : argument) quoted.append(c == '\'' ? "'\\''" : std::string(1, c));
  return quoted + "'";
}

std::string command_line() {
  std::ifstream arguments("/proc/self/cmdline", std::ios::binary);
  std::string line;
  for (std::string argument; std::getline(arguments, argument, '\0');) {
    line.append(line.empty() ? "" : " ").append(quoted_for_shell(argument));
  }
  return line;
}

std::string time_text(std::chrono::system_clock::time_point time) {
  const std::time_t seconds = std::chrono::system_clock::to_time_t(time);
  std::tm local = {};
  localtime_r(&seconds, &local);
  std::array<char, 32> text{};
  std::string stamp(text.data(),
                    std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%S%z", &local));
  return stamp.insert(stamp.size() - 2, ":");  // +0100 is not the same standard's
}

std::string host_name() {
  utsname names = {};
  return uname(&names) == 0 ? names.nodename : "";
}

}  // namespace

NamedValues run_origin() {
  std::error_code gone;
  return {{"command", command_line()},
          {"folder", std::filesystem::current_path(gone).string()},
          {"started", time_text(std::chrono::system_clock::now())},
          {"host", host_name()}};
}

}  // namespace lockbox::app
