// SPDX-License-Identifier: BSD-3-Clause
#include "manual_page.hpp"

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

#include "all_commands.hpp"
#include "command_line/option_checks.hpp"
#include "command_line/version.hpp"
#include "option_text.hpp"

namespace lockbox::app {
namespace {

/// A dash, a quote or a backslash would else be a typographic one, or an instruction; what stands
/// between backquotes becomes bold.
std::string escaped(const std::string& text) {
  std::string result;
  bool is_bold = false;
  for (const char letter : text) {
    if (letter == '`') {
      result += is_bold ? "\\fR" : "\\fB";
      is_bold = !is_bold;
    } else if (letter == '-') {
      result += "\\-";
    } else if (letter == '\'') {
      result += "\\(aq";
    } else if (letter == '\\') {
      result += "\\e";
    } else {
      result += letter;
    }
  }
  return result;
}

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::toupper(letter)); });
  return text;
}

/// No line of running text may begin with a full stop: that is an instruction.
std::string paragraph(const std::string& text) {
  return (text.starts_with('.') ? "\\&" : "") + escaped(text) + (text.ends_with('.') ? "" : ".") +
         '\n';
}

void write_title(std::ostream& out, const std::string& page, const std::string& summary) {
  out << ".TH " << escaped(upper(page)) << " 1 \"\" \"lockbox " << kVersion
      << "\" \"User Commands\"\n.SH NAME\n"
      << escaped(page) << " \\- " << escaped(summary) << '\n';
}

/// The names that a value must be one of; empty if the help text lists them.
std::string untold_choices(CLI::Option& option) {
  const std::string help = option.get_description();
  std::string list;
  bool is_told = true;
  for (const auto& name : choices_of(option)) {
    list.append(list.empty() ? "" : ", ").append(name);
    is_told = is_told && help.find(name) != std::string::npos;
  }
  return is_told ? "" : list;
}

void write_option(std::ostream& out, CLI::Option& option) {
  std::string names;
  for (const auto& name : names_of(option)) {
    names.append(names.empty() ? "" : ", ").append("\\fB" + escaped(name) + "\\fR");
  }
  const std::string value = value_name(option);
  out << ".TP\n" << names;
  if (!value.empty()) out << " \\fI" << escaped(value) << "\\fR";
  out << '\n' << paragraph(option.get_description());
  const std::string choices = untold_choices(option);
  if (!choices.empty()) out << paragraph("One of: " + choices);
  if (option.get_required()) out << "Required.\n";
  const std::string standard = option.get_default_str();
  if (!value.empty() && !standard.empty()) out << paragraph("Default: `" + standard + "`");
}

void write_options(std::ostream& out, CLI::App& options) {
  for (CLI::Option* option : options.get_options()) write_option(out, *option);
}

void write_subcommand(std::ostream& out, CLI::App& options) {
  std::string names = options.get_name();
  for (const auto& alias : options.get_aliases()) names.append(", ").append(alias);
  out << ".SS " << escaped(names) << '\n' << paragraph(options.get_description());
  write_options(out, options);
}

void write_example(std::ostream& out, const std::string& example) {
  out << ".SH EXAMPLE\n.EX\n" << escaped(example) << "\n.EE\n";
}

/// Writes, of the help text's end, the paragraphs that explain it.
void write_exit_status(std::ostream& out, const std::string& footer) {
  const std::string heading = "Exit status: ";
  const std::size_t begin = footer.find(heading);
  if (begin == std::string::npos) return;
  std::string text = footer.substr(begin + heading.size());
  out << ".SH EXIT STATUS\n";
  for (std::size_t end = text.find("\n\n"); end != std::string::npos; end = text.find("\n\n")) {
    out << paragraph(text.substr(0, end)) << ".PP\n";
    text.erase(0, end + 2);
  }
  out << paragraph(text);
}

void write_see_also(std::ostream& out, const std::string& page) {
  std::vector<std::string> pages = {"lockbox"};
  for (const auto& entry : command_list()) pages.push_back("lockbox-" + entry.name);
  std::erase(pages, page);
  out << ".SH SEE ALSO\n";
  for (const auto& other : pages) {
    out << ".BR " << escaped(other) << " (1)" << (other == pages.back() ? "\n" : ",\n");
  }
}

}  // namespace

void write_overview_page(std::ostream& out) {
  write_title(out, "lockbox", "track articulated objects with a depth camera");
  out << ".SH SYNOPSIS\n.B lockbox\n.I COMMAND\n[\\fIOPTIONS\\fR]\n.SH DESCRIPTION\n"
      << paragraph(
             "Tells for every frame of a depth camera or recording where an object is, and how "
             "each "
             "of its doors, drawers and sliders stands, with its uncertainty. The object is "
             "described by a URDF file with meshes")
      << ".SH COMMANDS\n";
  for (const auto& entry : command_list()) {
    out << ".TP\n.BR lockbox\\-" << escaped(entry.name) << " (1)\n" << paragraph(entry.summary);
  }
  out << ".SH FILES\n.TP\n.I share/lockbox/models\n"
      << paragraph("Models that are shipped, beside the folder of the program")
      << ".TP\n.I share/doc/lockbox/docs\n"
      << paragraph("Tutorial, how-tos and reference: what other pages call `docs`")
      << ".TP\n.I ~/.cache/lockbox\n"
      << paragraph("Distance fields of models that were used; it can be deleted");
  write_see_also(out, "lockbox");
}

void write_manual_page(std::ostream& out, const CommandEntry& entry) {
  const DeclaredCommand declared = declare(entry);
  CLI::App& options = *declared.options;
  const auto subcommands = subcommands_of(options);
  const std::string page = "lockbox-" + entry.name;
  write_title(out, page, entry.summary);
  out << ".SH SYNOPSIS\n.B lockbox " << entry.name << "\n[\\fIOPTIONS\\fR]\n";
  if (!subcommands.empty()) out << ".I SUBCOMMAND\n[\\fIOPTIONS\\fR]\n";
  out << ".SH DESCRIPTION\n" << paragraph(entry.description) << ".SH OPTIONS\n";
  write_options(out, options);
  if (!subcommands.empty()) out << ".SH SUBCOMMANDS\n";
  for (CLI::App* subcommand : subcommands) write_subcommand(out, *subcommand);
  write_example(out, entry.example);
  write_exit_status(out, options.get_footer());
  write_see_also(out, page);
}

}  // namespace lockbox::app
