// SPDX-License-Identifier: BSD-3-Clause
#include "small_experiment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "tool.hpp"

namespace lockbox {
namespace {

std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> result;
  std::stringstream stream(line + ",");  // so that an empty last field counts
  for (std::string field; std::getline(stream, field, ',');) result.push_back(field);
  return result;
}

}  // namespace

std::vector<NamedRow> read_rows(const std::filesystem::path& file) {
  const auto lines = read_lines(file);
  std::vector<NamedRow> rows;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const auto names = fields(lines.front());
    const auto values = fields(lines[i]);
    EXPECT_EQ(values.size(), names.size()) << file << ", line " << i + 1;
    NamedRow& row = rows.emplace_back();
    for (std::size_t c = 0; c < std::min(names.size(), values.size()); ++c) {
      row[names[c]] = values[c];
    }
  }
  return rows;
}

double number(const NamedRow& row, const std::string& column) {
  return std::stod(row.at(column));
}

std::string run_experiment(const std::string& name, const std::string& model,
                           const std::filesystem::path& output,
                           const std::vector<std::string>& options) {
  std::vector<std::string> arguments = {"experiment",    name,     "--model", model, "--output",
                                        output.string(), "--quiet"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const ToolResult result = run_tool(arguments);
  EXPECT_EQ(result.status, 0) << result.errors;
  return result.output;
}

}  // namespace lockbox
