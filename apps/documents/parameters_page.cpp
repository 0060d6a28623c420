// SPDX-License-Identifier: BSD-3-Clause
#include "parameters_page.hpp"

#include <array>
#include <string>

#include "all_commands.hpp"
#include "command_line/option_checks.hpp"
#include "documented_values.hpp"
#include "option_text.hpp"

namespace lockbox::app {
namespace {

/// A part of the tracker's options.
struct OptionHeader {
  const char* title;
  const char* file;
  const char* prefix;  ///< of its names in run.yaml
};

constexpr std::array kOptionHeaders = {
    OptionHeader{"Tracker", "modules/tracking/include/lockbox/tracking/tracker_options.hpp", ""},
    OptionHeader{"Registration",
                 "modules/registration/include/lockbox/registration/registration_options.hpp", ""},
    OptionHeader{"Terms", "modules/terms/include/lockbox/terms/term_options.hpp", ""},
    OptionHeader{"Measurements against predictions",
                 "modules/view/include/lockbox/view/view_options.hpp", ""},
    OptionHeader{"Noise of the sensor", "modules/sensor/include/lockbox/sensor/sensor_noise.hpp",
                 "noise_"},
    OptionHeader{"What rooms and built objects are like",
                 "modules/verification/include/lockbox/verification/evidence_options.hpp",
                 "evidence_"},
    OptionHeader{"Depths that are used", "modules/cloud/include/lockbox/cloud/cloud_options.hpp",
                 ""},
};

constexpr char kIntroduction[] = R"(# Parameters

<!-- Written by the program lockbox_documents; a test compares. Mend what it is made of, then:
     build/apps/documents/lockbox_documents --parameters . > docs/parameters.md -->

What a run of the tracker can be told, and what it goes by. A source that is *not recorded* is a value that
was chosen, and of which nobody has written down why.

## Options of `lockbox track`

On the command line with two dashes, or as lines `name = value` in the file of `--config`. `run.yaml` lists them
under `options`.

| name | value | default | effect |
|---|---|---|---|
)";

constexpr char kTrackerParameters[] = R"(
## Parameters of the tracker

Programs set them as members of `TrackerOptions`. `lockbox track` sets those that are the user's, and those of the
noise, its correlation and the range of depths by the sensor's [profile](sensors.md). `run.yaml` lists all as they were
in force, under `parameters`. `--set gate=3` sets any of them, as does a line `set = ["gate=3", "lambda_free=2"]` in the
file of `--config`; that counts more than the sensor's profile. Those of a model stand [beside it](file-formats.md#tracking-parameters-of-a-model-yaml).
)";

constexpr char kEvidence[] = R"(
Evidence and belief go by these ([verification](verification.md)). Belief is a probability with these values alone: with them it was
[compared](experiments-objects.md#is-belief-the-probability-that-it-says) with how often answers are right. Who changes one has to
measure that anew.

## Cells in which evidence is looked for

The code is laid out for these (`modules/verification/src/evidence_constants.hpp`): nothing sets them.

)";

/// Returns the text as it stands in a cell of a table.
std::string cell(const std::string& text) {
  std::string result;
  for (const char letter : text) {
    if (letter == '|') result += '\\';
    result += letter;
  }
  return result;
}

std::string code(const std::string& text) {
  return text.empty() ? "" : "`" + cell(text) + "`";
}

void write_option_row(std::ostream& out, CLI::Option& option) {
  const std::string value = value_name(option);
  const std::string standard = value.empty() ? "false" : option.get_default_str();
  out << "| " << code(option.get_lnames().front()) << " | " << code(value) << " | "
      << (option.get_required() ? "required" : code(standard)) << " | "
      << cell(option.get_description()) << " |\n";
}

void write_values(std::ostream& out, const std::filesystem::path& header,
                  const std::string& prefix) {
  out << "| name | unit | default | effect | source |\n|---|---|---|---|---|\n";
  for (const DocumentedValue& value : read_documented_values(header)) {
    out << "| " << code(prefix + value.name) << " | " << cell(value.unit) << " | "
        << code(value.standard) << " | " << cell(value.effect) << " | " << cell(value.source)
        << " |\n";
  }
}

}  // namespace

void write_parameters_page(std::ostream& out, const std::filesystem::path& sources) {
  const DeclaredCommand track = declare(*find_command("track"));
  out << kIntroduction;
  for (CLI::Option* option : track.options->get_options()) {
    if (option->get_configurable() && !option->get_lnames().empty()) write_option_row(out, *option);
  }
  out << kTrackerParameters;
  for (const OptionHeader& header : kOptionHeaders) {
    out << "\n### " << header.title << "\n\n";
    write_values(out, sources / header.file, header.prefix);
  }
  out << kEvidence;
  write_values(out, sources / "modules/verification/src/evidence_constants.hpp", "");
}

}  // namespace lockbox::app
