// SPDX-License-Identifier: BSD-3-Clause
// docs/parameters.md against what it is made of, and against what a run tells.
#include <gmock/gmock.h>

#include <sstream>

#include "block_runs.hpp"

namespace lockbox {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::string generated_page() {
  const ToolResult result =
      Tool({"--parameters", LOCKBOX_SOURCE_DIR}, {}, {}, LOCKBOX_DOCUMENTS).wait();
  EXPECT_EQ(result.status, 0) << result.errors;
  return result.output;
}

using Cells = std::vector<std::string>;

/// Rows of the tables below a heading, up to the next one of its level, without their heads.
std::vector<Cells> rows_below(const std::string& page, const std::string& heading) {
  std::vector<Cells> rows;
  std::istringstream lines(page.substr(page.find("\n## " + heading) + 1));
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line) && !line.starts_with("## ")) {
    if (!line.starts_with("| `")) continue;
    Cells& cells = rows.emplace_back();
    for (std::size_t begin = 2, end = 0; begin < line.size(); begin = end + 3) {
      end = line.find(" |", begin);
      cells.push_back(line.substr(begin, end - begin));
    }
  }
  return rows;
}

/// What stands between the first two backquotes.
std::string name_in(const Cells& row) {
  return row.front().substr(1, row.front().rfind('`') - 1);
}

std::vector<std::string> names_below(const std::string& page, const std::string& heading) {
  std::vector<std::string> names;
  for (const Cells& row : rows_below(page, heading)) names.push_back(name_in(row));
  return names;
}

/// The keys of a map in run.yaml.
std::vector<std::string> keys_of(const std::string& map, const std::vector<std::string>& lines) {
  std::vector<std::string> keys;
  auto line = std::find(lines.begin(), lines.end(), map + ":");
  while (line != lines.end() && ++line != lines.end() && line->starts_with("  ")) {
    keys.push_back(line->substr(2, line->find(':') - 2));
  }
  return keys;
}

TEST(ParametersPage, IsWhatTheSourcesSay) {
  EXPECT_EQ(generated_page(),
            read_text(std::filesystem::path(LOCKBOX_SOURCE_DIR) / "docs" / "parameters.md"))
      << "if the sources are right, write it anew: its first lines say how";
}

TEST(ParametersPage, TellsOfEachWhatItDoesAndWhereItIsFrom) {
  const std::string page = generated_page();
  for (const auto* heading :
       {"Parameters of the tracker", "Cells in which evidence is looked for"}) {
    const auto rows = rows_below(page, heading);
    EXPECT_THAT(rows, Not(IsEmpty()));
    for (const Cells& row : rows) {
      ASSERT_EQ(row.size(), 5U) << row.front();
      EXPECT_THAT(row[3], Not(IsEmpty())) << row.front();
      EXPECT_THAT(row[4], Not(IsEmpty())) << row.front() << " has no source";
    }
  }
}

class ParametersOfARun : public BlockRuns {};

TEST_F(ParametersOfARun, AreThoseOfThePage) {
  const auto result = run_tool(following("run", {"--max-frames", "1", "--quiet"}));
  ASSERT_EQ(result.status, 0) << result.errors;
  const auto run = read_lines(path("run/run.yaml"));
  const std::string page = generated_page();
  EXPECT_THAT(keys_of("parameters", run),
              testing::UnorderedElementsAreArray(names_below(page, "Parameters of the tracker")));
  EXPECT_THAT(names_below(page, "Options of `lockbox track`"), Contains("search-limit"));
  for (const auto& option : names_below(page, "Options of `lockbox track`")) {
    EXPECT_THAT(keys_of("options", run), Contains(option));
  }
}

TEST_F(ParametersOfARun, CanBeSetInAFileOfOptions) {
  const std::string options = path("options.toml");
  write_text(options, "set = [\"gate=3.5\", \"noise_depth_floor=0.001\", \"sight=1\"]\n");
  const std::vector<std::string> arguments = {"--max-frames", "1", "--quiet", "--config", options};
  const auto refused = run_tool(following("set", arguments));
  EXPECT_EQ(refused.status, 3);
  EXPECT_THAT(refused.errors, HasSubstr(options + ":1: "));
  EXPECT_THAT(refused.errors, HasSubstr("parameter 'sight': there is none of that name"));
  write_text(options, "set = [\"gate=3.5\", \"noise_depth_floor=0.001\", \"collision=off\"]\n");
  const auto result = run_tool(following("set", arguments));
  ASSERT_EQ(result.status, 0) << result.errors;
  const auto run = read_lines(path("set/run.yaml"));
  for (const auto* line : {"  gate: 3.5", "  noise_depth_floor: 0.001", "  collision: off"}) {
    EXPECT_THAT(run, Contains(line));
  }
}

TEST_F(ParametersOfARun, WithAValueThatIsNoneAreRefused) {
  const auto refusal = [](const std::string& setting) {
    const auto result = run_tool(following("none", {"--max-frames", "1", "--set", setting}));
    EXPECT_EQ(result.status, 2) << setting;
    return result.errors;
  };
  EXPECT_THAT(refusal("gate"), HasSubstr("NAME=VALUE"));
  EXPECT_THAT(refusal("gaet=3"), HasSubstr("did you mean gate?"));
  EXPECT_THAT(refusal("gate=wide"), HasSubstr("'wide' is not a number"));
  EXPECT_THAT(refusal("gate=0"), HasSubstr("'0' is not above 0"));
  EXPECT_THAT(refusal("most_rounds=1.5"), HasSubstr("'1.5' is not a whole number"));
  EXPECT_THAT(refusal("collision=hard"), HasSubstr("none of off, literal and eroded"));
  EXPECT_THAT(refusal("locked=true"), HasSubstr("--lock-joint"));
}

}  // namespace
}  // namespace lockbox
