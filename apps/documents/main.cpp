// SPDX-License-Identifier: BSD-3-Clause
// Writes manual pages and the completion of the command line, for the build, which installs them:
//   lockbox_documents FOLDER
// The folder is laid out as `share` of an installation is: `man/man1/*.1`,
// `bash-completion/completions/lockbox`. And docs/parameters.md, to standard output:
//   lockbox_documents --parameters FOLDER_OF_SOURCES
#include <filesystem>
#include <functional>
#include <iostream>
#include <sstream>

#include "command_line/command_list.hpp"
#include "command_line/program.hpp"
#include "command_line/whole_file.hpp"
#include "completion.hpp"
#include "manual_page.hpp"
#include "parameters_page.hpp"

namespace lockbox::app {
namespace {

namespace fs = std::filesystem;

void write_text(const fs::path& file, const std::function<void(std::ostream&)>& write) {
  std::ostringstream text;
  write(text);
  fs::create_directories(file.parent_path());
  write_whole_file(file, text.str());
}

void write_documents(const fs::path& share) {
  const auto pages = share / "man" / "man1";
  write_text(pages / "lockbox.1", write_overview_page);
  for (const auto& entry : command_list()) {
    write_text(pages / ("lockbox-" + entry.name + ".1"),
               [&](std::ostream& out) { write_manual_page(out, entry); });
  }
  const auto completions = share / "bash-completion" / "completions";
  write_text(completions / "lockbox", write_bash_completion);
  // bash looks for a completion by the name of the program.
  fs::remove(completions / "lockbox-experiment");
  fs::create_symlink("lockbox", completions / "lockbox-experiment");
}

ExitStatus run(const std::vector<std::string>& arguments) try {
  if (arguments.size() == 2 && arguments.front() == "--parameters") {
    write_parameters_page(std::cout, arguments.back());
  } else if (arguments.size() == 1 && !arguments.front().starts_with("-")) {
    write_documents(arguments.front());
  } else {
    return fail(ExitStatus::wrong_usage, "usage: lockbox_documents [--parameters] FOLDER");
  }
  return ExitStatus::done;
} catch (const std::exception& error) {
  return fail(ExitStatus::invalid_input, error.what());
}

}  // namespace
}  // namespace lockbox::app

int main(int argc, char** argv) {
  return lockbox::app::run_program(argc, argv, lockbox::app::run);
}
