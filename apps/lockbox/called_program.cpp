// SPDX-License-Identifier: BSD-3-Clause
#include "called_program.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "command_line/program.hpp"

namespace lockbox::app {

ExitStatus become_program(const std::string& name, const std::vector<std::string>& arguments) {
  std::string file = std::filesystem::read_symlink("/proc/self/exe").replace_filename(name);
  std::vector<std::string> words = arguments;
  std::vector<char*> pointers = {file.data()};
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  ::execv(file.c_str(), pointers.data());
  return fail(ExitStatus::invalid_input, file + ": cannot be started (" + std::strerror(errno) +
                                             "); install lockbox completely");
}

}  // namespace lockbox::app
