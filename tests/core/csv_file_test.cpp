// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/core/csv_file.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>

#include "lockbox/core/error.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

class CsvFileTest : public testing::Test {
 protected:
  std::filesystem::path file(const std::string& text) const {
    std::ofstream(folder_ / "rows.csv", std::ios::binary) << text;
    return folder_ / "rows.csv";
  }

  const TemporaryFolder folder_;
};

TEST_F(CsvFileTest, ReadsRowsBelowTheHeader) {
  CsvFile csv(file("\xEF\xBB\xBF# two numbers\na, b\r\n1,nan\r\n\n 2 ,-inf\n"));
  EXPECT_THAT(csv.columns(), ElementsAre("a", "b"));
  EXPECT_EQ(csv.column("b"), 1U);
  EXPECT_EQ(csv.column("c"), std::nullopt);
  CsvRow row;
  ASSERT_TRUE(csv.next(row));
  EXPECT_EQ(row.number(0), 1.0);
  EXPECT_TRUE(std::isnan(row.number(1)));
  ASSERT_TRUE(csv.next(row));
  EXPECT_THAT(row.fields(), ElementsAre("2", "-inf"));
  EXPECT_FALSE(csv.next(row));
}

TEST_F(CsvFileTest, LeavesOutAnUnfinishedRowWhereAsked) {
  const auto rows = [&](const std::string& text, UnfinishedRow last) {
    CsvFile csv(file(text), last);
    int count = 0;
    for (CsvRow row; csv.next(row);) ++count;
    return count;
  };
  EXPECT_EQ(rows("a,b\n1,2\n3,4", UnfinishedRow::read), 2);
  EXPECT_EQ(rows("a,b\n1,2\n3,4", UnfinishedRow::left_out), 1);
  EXPECT_EQ(rows("a,b\n1,2\n3", UnfinishedRow::left_out), 1);
  EXPECT_EQ(rows("a,b\n1,2\n3,4\n", UnfinishedRow::left_out), 2);
  EXPECT_EQ(rows("a,b", UnfinishedRow::left_out), 0);
  EXPECT_EQ(rows("", UnfinishedRow::left_out), 0);
}

TEST_F(CsvFileTest, SaysWhereAndWhatIsWrong) {
  CsvFile csv(file("# comment\na,b\n1,x\n1,2,3\n"));
  EXPECT_THAT(
      [&] { csv.require_header("a,c", "results"); },
      ThrowsMessage<InputError>(HasSubstr("rows.csv:2: is not the header of results: a,c")));
  csv.require_header("a,b", "results");
  CsvRow row;
  ASSERT_TRUE(csv.next(row));
  EXPECT_THAT([&] { row.number(1); },
              ThrowsMessage<InputError>(HasSubstr("rows.csv:3: column 'b': 'x' is no number")));
  EXPECT_THAT([&] { csv.next(row); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("rows.csv:4: has 3 fields, the header 2"),
                                              HasSubstr("cut off"))));
}

}  // namespace
}  // namespace lockbox
