// SPDX-License-Identifier: BSD-3-Clause
#include "tool.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace lockbox {
namespace {

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> result;
  result.reserve(texts.size() + 1);
  for (auto& text : texts) result.push_back(text.data());
  result.push_back(nullptr);
  return result;
}

}  // namespace

Tool::Tool(const std::vector<std::string>& arguments, const std::vector<std::string>& environment,
           const std::filesystem::path& output, const std::string& program) {
  std::vector<std::string> command = {program};
  command.insert(command.end(), arguments.begin(), arguments.end());
  std::vector<std::string> variables = {std::string("XDG_CACHE_HOME=") + LOCKBOX_CACHE};
  for (char** entry = environ; *entry != nullptr; ++entry) {
    if (!std::string(*entry).starts_with("XDG_CACHE_HOME=")) variables.emplace_back(*entry);
  }
  variables.insert(variables.begin(), environment.begin(), environment.end());

  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  const auto writing = O_WRONLY | O_CREAT | O_TRUNC;
  posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
  const auto output_file = output.empty() ? folder_ / "output" : output;
  posix_spawn_file_actions_addopen(&files, 1, output_file.c_str(), writing, 0600);
  posix_spawn_file_actions_addopen(&files, 2, (folder_ / "errors").c_str(), writing, 0600);
  posix_spawnattr_t own_group;  // and signals that do what they usually do
  posix_spawnattr_init(&own_group);
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGHUP, SIGINT, SIGPIPE, SIGTERM}) sigaddset(&signals, signal);
  posix_spawnattr_setsigdefault(&own_group, &signals);
  posix_spawnattr_setflags(&own_group, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
  const int failure = posix_spawn(&process_, program.c_str(), &files, &own_group,
                                  pointers(command).data(), pointers(variables).data());
  posix_spawnattr_destroy(&own_group);
  posix_spawn_file_actions_destroy(&files);
  if (failure != 0) throw std::runtime_error("cannot start " + program);
}

void Tool::wait_for_handler(int signal) const {
  const std::string caught = "SigCgt:";  // a mask in hexadecimal numbers
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (std::chrono::steady_clock::now() < give_up) {
    for (const auto& line : read_lines("/proc/" + std::to_string(process_) + "/status")) {
      if (!line.starts_with(caught)) continue;
      if ((std::stoull(line.substr(caught.size()), nullptr, 16) >> (signal - 1) & 1U) != 0) return;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

void Tool::send_signal(int signal) const {
  kill(-process_, signal);
}

std::filesystem::path Tool::program() const {
  return std::filesystem::read_symlink("/proc/" + std::to_string(process_) + "/exe");
}

ToolResult Tool::wait() {
  int state = 0;
  waitpid(process_, &state, 0);
  const int status = WIFEXITED(state) ? WEXITSTATUS(state) : -WTERMSIG(state);
  return {status, read_text(folder_ / "output"), read_text(folder_ / "errors")};
}

ToolResult run_tool(const std::vector<std::string>& arguments,
                    const std::vector<std::string>& environment) {
  return Tool(arguments, environment).wait();
}

std::string read_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

std::vector<std::string> read_lines(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> rows_without_latency(const std::filesystem::path& file) {
  auto lines = read_lines(file);
  for (auto& line : lines) {  // belief and alternatives are behind it
    const auto end = line.rfind(',', line.rfind(',') - 1);
    const auto begin = line.rfind(',', end - 1);
    line.erase(begin, end - begin);
  }
  return lines;
}

}  // namespace lockbox
