// SPDX-License-Identifier: BSD-3-Clause
// Simulated objects that are not quite their model.
#include <gmock/gmock.h>

#include "tool.hpp"

namespace lockbox {
namespace {

using testing::HasSubstr;

ToolResult simulate(const std::filesystem::path& output, const std::vector<std::string>& options) {
  std::vector<std::string> arguments = {
      "simulate", "--model",  "cabinet", "--trajectory", "auto",          "--frames",
      "4",        "--sensor", "ideal",   "--output",     output.string(), "--quiet"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  return run_tool(arguments);
}

TEST(Deviation, IsShownAndToldInRunYamlWhileTheTruthIsTheModels) {
  const TemporaryFolder folder;
  write_text(folder / "built.yaml", "seed: 3\nobject: {scale: 1.02, missing_parts: [door]}\n");
  const auto options = std::vector<std::string>{"--deviation", folder / "built.yaml"};
  ASSERT_EQ(simulate(folder / "exact", {}).status, 0);
  ASSERT_EQ(simulate(folder / "built", options).status, 0);
  EXPECT_EQ(read_text(folder / "built/groundtruth.csv"),
            read_text(folder / "exact/groundtruth.csv"));
  const std::string last = read_lines(folder / "exact/depth.txt").back();
  const std::string image = last.substr(last.find(' ') + 1);
  EXPECT_NE(read_text(folder / ("built/" + image)), read_text(folder / ("exact/" + image)));
  const std::string record = read_text(folder / "built/run.yaml");
  EXPECT_THAT(record, HasSubstr("scale: 1.02"));
  EXPECT_THAT(record, HasSubstr("cabinet.urdf"));
  EXPECT_FALSE(std::filesystem::exists(folder / "exact/run.yaml"));
}

TEST(Deviation, OfTheCameraHasATruthAsTheCalibrationShowsIt) {
  const TemporaryFolder folder;
  write_text(folder / "d.yaml", "camera: {principal_point: [12, 0]}\nframes: {rate: 15}\n");
  ASSERT_EQ(simulate(folder / "o", {"--deviation", folder / "d.yaml"}).status, 0);
  const auto plain = read_lines(folder / "o/groundtruth.csv");
  const auto apparent = read_lines(folder / "o/groundtruth_apparent.csv");
  ASSERT_EQ(plain.size(), 3U);  // a header, and two of four frames
  ASSERT_EQ(apparent.size(), 3U);
  const auto x_of = [](const std::string& row) { return std::stod(row.substr(row.find(',') + 1)); };
  EXPECT_NEAR(x_of(apparent[1]) - x_of(plain[1]), 12.0 / 575.8 * 1.1, 0.005);
}

TEST(Deviation, FilesThatAreWrongAreRefusedWithTheKey) {
  const TemporaryFolder folder;
  write_text(folder / "wrong.yaml", "object: {skale: 1.02}\n");
  const auto result = simulate(folder / "o", {"--deviation", folder / "wrong.yaml"});
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(result.errors, HasSubstr("wrong.yaml:1"));
  EXPECT_THAT(result.errors, HasSubstr("'skale'"));
}

TEST(Deviation, ThatTheModelDoesNotAllowIsRefusedWithTheFile) {
  const TemporaryFolder folder;
  for (const std::string object : {"missing_parts: [nothing]", "missing_handles: 90"}) {
    write_text(folder / "wrong.yaml", "object: {" + object + "}\n");
    const auto result = simulate(folder / "o", {"--deviation", folder / "wrong.yaml"});
    EXPECT_EQ(result.status, 3);
    EXPECT_THAT(result.errors, HasSubstr("wrong.yaml: missing_"));
  }
}

}  // namespace
}  // namespace lockbox
