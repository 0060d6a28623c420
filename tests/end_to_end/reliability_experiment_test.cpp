// SPDX-License-Identifier: BSD-3-Clause
// Stated beliefs of several experiments' rows, against what is true.
#include <gmock/gmock.h>

#include "tool.hpp"

namespace lockbox {
namespace {

using testing::HasSubstr;
using testing::Not;

class ReliabilityExperiment : public testing::Test {
 protected:
  /// Rows with the columns that it reads, among others.
  std::string rows(const std::string& name, const std::string& header, const std::string& row,
                   int count) const {
    std::string text = header + '\n';
    for (int i = 0; i < count; ++i) text += row + '\n';
    write_text(folder_ / name, text);
    return (folder_ / name).string();
  }

  ToolResult run(const std::vector<std::string>& files) const {
    std::vector<std::string> arguments{"experiment", "reliability", "--output",
                                       (folder_ / "out").string()};
    for (const std::string& file : files) {
      arguments.insert(arguments.end(), {"--rows", file});
    }
    return run_tool(arguments);
  }

  TemporaryFolder folder_;
};

TEST_F(ReliabilityExperiment, PoolsTheRowsOfAllFiles) {
  const auto a =
      rows("a.csv", "piece,looks_equal,status,within,belief", "1,0,tracking,1,0.9999", 40);
  const auto b = rows("b.csv", "kind,right,status,belief", "mug,0,uncertain,0.2", 60);
  const ToolResult result = run({a, b});
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_THAT(result.output, HasSubstr("a.csv: 40 answers"));
  EXPECT_THAT(result.output, HasSubstr("b.csv: 60 answers"));
  EXPECT_THAT(result.output, HasSubstr("0.999 to 1.000      40     40"));
  EXPECT_THAT(result.output, testing::ContainsRegex("0.200 to 0.300      60      0 .*outside"));
  EXPECT_THAT(result.output, HasSubstr("constant   Brier score 0.2400"));
  EXPECT_THAT(result.output, HasSubstr("status     Brier score 0.0000"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/reliability.gp"));
}

TEST_F(ReliabilityExperiment, LeavesOutWhatIsNoAnswerAndWhatLooksTheSame) {
  const std::string header = "piece,looks_equal,status,within,belief";
  const ToolResult result = run({rows("none.csv", header, "1,0,initializing,0,0", 5),
                                 rows("same.csv", header, "2,1,tracking,0,0.9", 5)});
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_THAT(result.output, HasSubstr("none.csv: 0 answers"));
  EXPECT_THAT(result.output, HasSubstr("same.csv: 0 answers"));
}

TEST_F(ReliabilityExperiment, RefusesRowsWithoutBeliefByTheirName) {
  const ToolResult result = run({rows("speed.csv", "frame,status", "1,tracking", 1)});
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(result.errors, HasSubstr("speed.csv:1: has no column 'belief'"));
  EXPECT_THAT(result.errors, Not(HasSubstr("terminate")));
}

}  // namespace
}  // namespace lockbox
