// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "lockbox/core/error.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

const std::vector<std::string> kColumns = {"name", "value"};

class TableFile : public testing::Test {
 protected:
  const TemporaryFolder folder_;
};

TEST_F(TableFile, ComesBackAsItWasWritten) {
  Table table(kColumns);
  table.add({"a", 0.1});
  table.add({"b", std::nan("")});
  const auto file = folder_ / "table.csv";
  write_table(file, table);
  const Table read = read_table(file, kColumns);
  ASSERT_EQ(read.rows().size(), 2U);
  EXPECT_EQ(read.word(read.rows()[0], "name"), "a");
  EXPECT_EQ(read.number(read.rows()[0], "value"), 0.1);
  EXPECT_TRUE(std::isnan(read.number(read.rows()[1], "value")));
}

TEST_F(TableFile, GrowsRowByRow) {
  const auto file = folder_ / "growing_table.csv";
  write_table(file, Table(kColumns));
  append_row(file, {"a", 1});
  append_row(file, {"b", 2});
  const Table read = read_table(file, kColumns);
  ASSERT_EQ(read.rows().size(), 2U);
  EXPECT_EQ(read.number(read.rows()[1], "value"), 2.0);
}

TEST_F(TableFile, LeavesOutARowThatWasCutOff) {
  const auto file = folder_ / "cut_off_table.csv";
  write_table(file, Table(kColumns));
  append_row(file, {"a", 1});
  std::ofstream(file, std::ios::app) << "b,1";
  EXPECT_EQ(read_table(file, kColumns).rows().size(), 1U);
}

TEST_F(TableFile, RefusesOtherColumns) {
  const auto file = folder_ / "other_table.csv";
  write_table(file, Table({"name", "size"}));
  EXPECT_THROW(read_table(file, kColumns), InputError);
}

TEST_F(TableFile, NamesTheLineWithTooManyFields) {
  const auto file = folder_ / "wide_table.csv";
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
