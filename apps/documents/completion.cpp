// SPDX-License-Identifier: BSD-3-Clause
#include "completion.hpp"

#include <cctype>
#include <sstream>
#include <string>
#include <vector>

#include "all_commands.hpp"
#include "command_line/option_checks.hpp"
#include "option_text.hpp"

namespace lockbox::app {
namespace {

/// Two tables are there by then: the words that may follow a command, or an option of a command,
/// and the kind of path that may follow an option. An equals sign is a word of its own to bash.
/// `lockbox-experiment` is `lockbox experiment`.
constexpr auto kFunction = R"bash(
_lockbox() {
  local word=${COMP_WORDS[COMP_CWORD]} option=${COMP_WORDS[COMP_CWORD - 1]} key=${COMP_WORDS[0]##*/} i
  key=${key/-/ }
  if [[ $word == '=' ]]; then
    word=
  elif [[ $option == '=' ]]; then
    option=${COMP_WORDS[COMP_CWORD - 2]}
  fi
  for ((i = 1; i < COMP_CWORD; ++i)); do
    [[ -n ${_lockbox_words["$key ${COMP_WORDS[i]}"]+known} && ${COMP_WORDS[i]} != -* ]] &&
      key+=" ${COMP_WORDS[i]}"
  done
  [[ -n ${_lockbox_words["$key $option"]+known} && $option == -* ]] && key+=" $option"
  mapfile -t COMPREPLY < <(compgen -W "${_lockbox_words["$key"]}" -- "$word")
  [[ ${COMPREPLY[0]-} == *: ]] && compopt -o nospace 2>/dev/null
  local list
  case ${_lockbox_paths["$key"]} in
    file) list=-f ;;
    folder) list=-d ;;
    *) return ;;
  esac
  compopt -o filenames 2>/dev/null
  mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen "$list" -- "$word")
}
complete -F _lockbox lockbox lockbox-experiment
)bash";

std::string joined(const std::vector<std::string>& words) {
  std::string line;
  for (const auto& word : words) line.append(line.empty() ? "" : " ").append(word);
  return line;
}

/// What bash can list for a value of this name.
std::string kind_of_path(const std::string& value) {
  if (value.find("FILE") != std::string::npos || value == "SOURCE") return "file";
  return value.find("DIR") != std::string::npos ? "folder" : "";
}

/// The `auto` of `FILE|auto`.
std::vector<std::string> literals_in(const std::string& value) {
  std::vector<std::string> literals;
  std::istringstream parts(value);
  for (std::string part; std::getline(parts, part, '|');) {
    if (!part.empty() && std::islower(static_cast<unsigned char>(part.front())) != 0)
      literals.push_back(part);
  }
  return literals;
}

class Tables {
 public:
  /// The options of a command, and of the command that it is a part of, and its subcommands.
  void add(const std::string& key, CLI::App& options, std::vector<std::string> words) {
    for (CLI::App* part = &options; part != nullptr; part = part->get_parent()) {
      for (CLI::Option* option : part->get_options()) add_option(key, *option, words);
    }
    add_words(key, words);
    for (CLI::App* subcommand : subcommands_of(options)) {
      add(key + ' ' + subcommand->get_name(), *subcommand, {});
    }
  }

  void add_words(const std::string& key, const std::vector<std::string>& words) {
    words_ += "  [\"" + key + "\"]=\"" + joined(words) + "\"\n";
  }

  void write(std::ostream& out) const {
    out << "declare -gA _lockbox_words=(\n"
        << words_ << ")\ndeclare -gA _lockbox_paths=(\n"
        << paths_ << ")\n";
  }

 private:
  void add_option(const std::string& key, CLI::Option& option, std::vector<std::string>& words) {
    const std::string value = value_name(option);
    for (const auto& name : names_of(option)) {
      words.push_back(name);
      if (value.empty()) continue;
      std::string own_key = key;
      own_key.append(" ").append(name);
      std::vector<std::string> values = literals_in(value);
      for (const auto& suggestion : suggestions_of(option)) values.push_back(suggestion);
      add_words(own_key, values);
      const std::string path = kind_of_path(value);
      if (!path.empty()) paths_ += "  [\"" + own_key + "\"]=" + path + '\n';
    }
  }

  std::string words_;
  std::string paths_;
};

std::vector<std::string> names_of_subcommands(CLI::App& options) {
  std::vector<std::string> names;
  for (CLI::App* subcommand : subcommands_of(options)) {
    names.push_back(subcommand->get_name());
  }
  return names;
}

}  // namespace

void write_bash_completion(std::ostream& out) {
  out << "# SPDX-License-Identifier: BSD-3-Clause\n"
         "# Completion of the command line of lockbox for bash, generated from its options.\n";
  Tables tables;
  std::vector<std::string> names;
  for (const auto& entry : command_list()) {
    names.push_back(entry.name);
    const DeclaredCommand declared = declare(entry);
    tables.add("lockbox " + entry.name, *declared.options, names_of_subcommands(*declared.options));
  }
  tables.add_words("lockbox help", names);
  for (const auto* other : {"help", "--help", "--version"}) names.emplace_back(other);
  tables.add_words("lockbox", names);
  tables.write(out);
  out << kFunction;
}

}  // namespace lockbox::app
