// SPDX-License-Identifier: BSD-3-Clause
#include "documents.hpp"

#include <functional>
#include <sstream>
#include <string>

#include "command_line/command_list.hpp"
#include "command_line/whole_file.hpp"
#include "commands.hpp"
#include "completion.hpp"
#include "manual_page.hpp"

namespace lockbox::app {
namespace {

void write_text(const std::filesystem::path& file,
                const std::function<void(std::ostream&)>& write) {
  std::ostringstream text;
  write(text);
  std::filesystem::create_directories(file.parent_path());
  write_whole_file(file, text.str());
}

}  // namespace

void write_documents(const std::filesystem::path& share) {
  const auto pages = share / "man" / "man1";
  write_text(pages / "lockbox.1", write_overview_page);
  for (const auto& entry : command_list()) {
    write_text(pages / ("lockbox-" + entry.name + ".1"),
               [&](std::ostream& out) { write_manual_page(out, entry); });
  }
  write_text(share / "bash-completion" / "completions" / "lockbox", write_bash_completion);
}

}  // namespace lockbox::app
