// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "lockbox/core/error.hpp"

namespace lockbox {
namespace {

const std::vector<std::string> kColumns = {"name", "value"};

std::filesystem::path temporary(const std::string& name) {
  return std::filesystem::path(testing::TempDir()) / name;
}

TEST(Table, ComesBackAsItWasWritten) {
  Table table(kColumns);
  table.add({"a", 0.1});
  table.add({"b", std::nan("")});
  const auto file = temporary("table.csv");
  write_table(file, table);
  const Table read = read_table(file, kColumns);
  ASSERT_EQ(read.rows().size(), 2U);
  EXPECT_EQ(read.word(read.rows()[0], "name"), "a");
  EXPECT_EQ(read.number(read.rows()[0], "value"), 0.1);
  EXPECT_TRUE(std::isnan(read.number(read.rows()[1], "value")));
}

TEST(Table, GrowsRowByRow) {
  const auto file = temporary("growing_table.csv");
  write_table(file, Table(kColumns));
  append_row(file, {"a", 1});
  append_row(file, {"b", 2});
  const Table read = read_table(file, kColumns);
  ASSERT_EQ(read.rows().size(), 2U);
  EXPECT_EQ(read.number(read.rows()[1], "value"), 2.0);
}

TEST(Table, LeavesOutARowThatWasCutOff) {
  const auto file = temporary("cut_off_table.csv");
  write_table(file, Table(kColumns));
  append_row(file, {"a", 1});
  std::ofstream(file, std::ios::app) << "b,1";
  EXPECT_EQ(read_table(file, kColumns).rows().size(), 1U);
}

TEST(Table, RefusesOtherColumns) {
  const auto file = temporary("other_table.csv");
  write_table(file, Table({"name", "size"}));
  EXPECT_THROW(read_table(file, kColumns), InputError);
}

TEST(Table, NamesTheLineWithTooManyFields) {
  const auto file = temporary("wide_table.csv");
  write_table(file, Table(kColumns));
  append_row(file, {"a", 1, 2});
  try {
    read_table(file, kColumns);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(file.string() + ":2"), std::string::npos);
  }
}

TEST(Table, RefusesAWordWhereANumberIsWanted) {
  Table table(kColumns);
  table.add({"a", "b"});
  EXPECT_THROW(table.number(table.rows()[0], "value"), InputError);
}

}  // namespace
}  // namespace lockbox
