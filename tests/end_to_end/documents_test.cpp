// SPDX-License-Identifier: BSD-3-Clause
// Manual pages and the completion of the command line, read by groff and used by bash.
#include <gmock/gmock.h>

#include <cstdlib>
#include <regex>
#include <sstream>

#include "tool.hpp"

namespace lockbox {
namespace {

using testing::Contains;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::IsSupersetOf;
using testing::Not;
using testing::UnorderedElementsAre;

const std::vector<std::string> kCommands = {
    "track", "simulate", "record", "evaluate", "experiment", "inspect", "view", "devices", "cache"};

/// Runs it in bash; fails the test that expects success.
ToolResult run_shell(const std::string& script) {
  const TemporaryFolder folder;
  const auto file = folder.write("script", script);
  const std::string command = "bash " + file.string() + " >" + (folder / "output").string() +
                              " 2>" + (folder / "errors").string();
  const int status = std::system(command.c_str());
  return {status, read_text(folder / "output"), read_text(folder / "errors")};
}

/// The documents, written once for all tests.
const std::filesystem::path& documents() {
  static const TemporaryFolder folder;
  static const ToolResult written = run_shell(LOCKBOX_DOCUMENTS " " + folder.path().string());
  EXPECT_EQ(written.status, 0) << written.errors;
  return folder.path();
}

/// As a reader sees it, on lines that are long enough to leave options whole.
ToolResult rendered(const std::string& page) {
  return run_shell("groff -ww -man -Tutf8 -P-cbou -rLL=200n " +
                   (documents() / "man" / "man1" / (page + ".1")).string());
}

/// All that begin a line of a help text: `--model` of `  -m,--model FILE REQUIRED`.
std::vector<std::string> options_in(const std::string& help) {
  static const std::regex option("\n  (?:(-[a-z]),)?(--[a-z][a-z-]*)");
  std::vector<std::string> options;
  for (std::sregex_iterator match(help.begin(), help.end(), option), end; match != end; ++match) {
    options.push_back((*match)[2]);
    if ((*match)[1].matched) options.push_back((*match)[1]);
  }
  return options;
}

/// What bash would propose for the last of these words.
std::vector<std::string> proposed(const std::vector<std::string>& words) {
  std::string line;
  for (const auto& word : words) line.append(" '").append(word).append("'");
  const auto result = run_shell(
      "set -eu; source " + (documents() / "bash-completion/completions/lockbox").string() +
      "\ncd " + documents().string() + "\nCOMP_WORDS=(lockbox" + line +
      ")\nCOMP_CWORD=" + std::to_string(words.size()) +
      "\nset +eu; _lockbox; (( ${#COMPREPLY[@]} == 0 )) || printf '%s\\n' \"${COMPREPLY[@]}\"\n");
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_THAT(result.errors, IsEmpty());
  std::istringstream lines(result.output);
  std::vector<std::string> proposals;
  for (std::string proposal; std::getline(lines, proposal);) proposals.push_back(proposal);
  return proposals;
}

TEST(ManualPage, OfEachCommandHasAllItsOptionsAndItsExample) {
  for (const auto& command : kCommands) {
    const auto page = rendered("lockbox-" + command);
    EXPECT_EQ(page.status, 0) << command;
    EXPECT_THAT(page.errors, IsEmpty()) << command;
    const std::string help = run_tool({command, "--help"}).output;
    const auto options = options_in(help);
    EXPECT_THAT(options, Contains("--help"));
    for (const auto& option : options) EXPECT_THAT(page.output, HasSubstr(option)) << command;
    EXPECT_THAT(page.output, ContainsRegex("DESCRIPTION\n +[A-Z][^\n]{30}")) << command;
    EXPECT_THAT(page.output, Not(ContainsRegex("\\b(UINT|INT|FLOAT|TEXT)\\b"))) << command;
    const std::size_t example = help.find("lockbox " + command, help.find("Example:"));
    EXPECT_THAT(page.output, HasSubstr(help.substr(example, help.find('\n', example) - example)));
  }
}

TEST(ManualPage, OfExperimentsHasThoseOfEach) {
  const std::string page = rendered("lockbox-experiment").output;
  for (const auto& option : options_in(run_tool({"experiment", "peers", "--help"}).output)) {
    EXPECT_THAT(page, HasSubstr(option));
  }
  EXPECT_THAT(page, HasSubstr("The scene on which M3T was measured"));
  EXPECT_THAT(page, HasSubstr("One of: static, moving, "));
}

TEST(ManualPage, SaysWhatAValueIsAndWhatItMayBe) {
  const std::string page = rendered("lockbox-track").output;
  EXPECT_THAT(page, HasSubstr("-m, --model FILE\n"));
  EXPECT_THAT(page, ContainsRegex("off, literal or eroded\\. +Default: eroded\\."));
  EXPECT_THAT(page, HasSubstr("EXIT STATUS"));
  EXPECT_THAT(page, Not(HasSubstr("`")));
}

TEST(ManualPage, OfTheToolNamesThePagesOfItsCommands) {
  const auto page = rendered("lockbox");
  EXPECT_THAT(page.errors, IsEmpty());
  for (const auto& command : kCommands) {
    EXPECT_THAT(page.output, HasSubstr("lockbox-" + command + "(1)"));
  }
}

TEST(Completion, ProposesCommands) {
  EXPECT_THAT(proposed({""}), IsSupersetOf(kCommands));
  EXPECT_THAT(proposed({"tr"}), UnorderedElementsAre("track"));
  EXPECT_THAT(proposed({"help", "ex"}), UnorderedElementsAre("experiment"));
}

TEST(Completion, ProposesOptionsOfTheCommand) {
  for (const auto& command : kCommands) {
    EXPECT_THAT(proposed({command, "--"}),
                IsSupersetOf({std::string("--help"), std::string("--config")}));
  }
  EXPECT_THAT(proposed({"track", "--snap"}),
              UnorderedElementsAre("--snapshots", "--snapshot-interval"));
  EXPECT_THAT(proposed({"track", "--quiet", "--sou"}), UnorderedElementsAre("--source"));
  EXPECT_THAT(proposed({"record", "--snap"}), IsEmpty());
}

TEST(Completion, ProposesNamesThatValuesMayBe) {
  EXPECT_THAT(proposed({"track", "--collision", ""}),
              UnorderedElementsAre("off", "literal", "eroded"));
  EXPECT_THAT(proposed({"track", "--collision", "=", "er"}), UnorderedElementsAre("eroded"));
  EXPECT_THAT(proposed({"track", "--collision", "="}),
              UnorderedElementsAre("off", "literal", "eroded"));
  EXPECT_THAT(proposed({"track", "-m", "rigid"}), UnorderedElementsAre("rigid_block"));
  EXPECT_THAT(proposed({"track", "--initial-state", "au"}), UnorderedElementsAre("auto"));
  EXPECT_THAT(proposed({"track", "--max-frames", ""}), IsEmpty());
  EXPECT_THAT(proposed({"track", "--publish", ""}),
              UnorderedElementsAre("stdout", "tcp:", "unix:", "udp:"));
  EXPECT_THAT(proposed({"record", "--mode", "320"}),
              UnorderedElementsAre("320x240@30", "320x240@60"));
}

TEST(Completion, ProposesFilesAndFolders) {
  EXPECT_THAT(proposed({"track", "--config", "ma"}), UnorderedElementsAre("man"));
  EXPECT_THAT(proposed({"track", "--config", "man/man1/lockbox-v"}),
              UnorderedElementsAre("man/man1/lockbox-view.1"));
  EXPECT_THAT(proposed({"track", "--output", "man/man1/"}), IsEmpty());
  EXPECT_THAT(proposed({"track", "--output", "man/"}), UnorderedElementsAre("man/man1"));
}

TEST(Completion, KnowsTheOptionsOfExperiments) {
  EXPECT_THAT(proposed({"experiment", "pee"}), UnorderedElementsAre("peers"));
  EXPECT_THAT(proposed({"experiment", "peers", "--se"}),
              UnorderedElementsAre("--seed", "--seeds", "--sensor", "--sequence"));
  EXPECT_THAT(proposed({"experiment", "peers", "--sequence", "st"}),
              UnorderedElementsAre("static"));
  EXPECT_THAT(proposed({"experiment", "global", "--seq"}), IsEmpty());
}

TEST(Completion, IsTheSameForTheProgramOfExperiments) {
  const auto file = documents() / "bash-completion/completions/lockbox-experiment";
  const auto result = run_shell("source " + file.string() +
                                "\nCOMP_WORDS=(/usr/bin/lockbox-experiment peers --seq)\n"
                                "COMP_CWORD=2\n_lockbox; printf '%s\\n' \"${COMPREPLY[@]}\"\n"
                                "complete -p lockbox-experiment\n");
  EXPECT_EQ(result.output, "--sequence\ncomplete -F _lockbox lockbox-experiment\n");
}

TEST(Documents, NeedAFolder) {
  EXPECT_EQ(WEXITSTATUS(run_shell(LOCKBOX_DOCUMENTS).status), 2);
  EXPECT_EQ(WEXITSTATUS(run_shell(LOCKBOX_DOCUMENTS " /dev/null/x").status), 3);
}

}  // namespace
}  // namespace lockbox
