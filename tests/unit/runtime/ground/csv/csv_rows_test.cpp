#include "runtime/ground/csv/csv_rows.h"

#include <gtest/gtest.h>

#include <sstream>

namespace stepwright::csv {
namespace {

using Row = std::vector<std::string>;

struct Read {
  std::vector<Row> rows;
  std::string error;  // as people see it
};

Read read(const std::string& text) {
  std::istringstream in(text);
  CsvRows rows(in, "t.csv", "L0041");
  Read all;
  while (rows.next()) all.rows.push_back(rows.fields());
  if (rows.error()) all.error = result::to_string(*rows.error());
  return all;
}

TEST(CsvRows, WhenLinesEndInAnyWay_ThenRowsAreTheSame) {
  const std::vector<Row> expected = {{"a", "b"}, {"1", ""}, {"", "2"}};
  for (const char* text : {"a,b\n1,\n,2\n", "a,b\r\n1,\r\n,2\r\n", "a,b\n1,\n,2", "\na,b\n\n1,\n,2\n\n"})
    EXPECT_EQ(read(text).rows, expected) << text;
  EXPECT_TRUE(read("").rows.empty());
}

TEST(CsvRows, WhenAByteOrderMarkStandsBeforeTheTable_ThenItIsNoPartOfIt) {
  EXPECT_EQ(read("\xEF\xBB\xBFname,b\n1,2\n").rows, (std::vector<Row>{{"name", "b"}, {"1", "2"}}));
  EXPECT_EQ(read("\xEF\xBB\xBF\"na,me\",b\n").rows, (std::vector<Row>{{"na,me", "b"}}));
  EXPECT_EQ(read("\xEF\xBBx,b\n\xEF\xBB\xBFy\n").rows,
            (std::vector<Row>{{"\xEF\xBBx", "b"}, {"\xEF\xBB\xBFy"}}));
  EXPECT_TRUE(read("\xEF\xBB\xBF").rows.empty());
}

TEST(CsvRows, WhenAFieldIsQuoted_ThenItMayHoldAnything) {
  const Read all = read("\"a,\"\"b\"\"\",\"two\nlines\",\"\"\nx,y\"z,\n");
  EXPECT_EQ(all.error, "");
  EXPECT_EQ(all.rows, (std::vector<Row>{{"a,\"b\"", "two\nlines", ""}, {"x", "y\"z", ""}}));
}

TEST(CsvRows, WhenAFieldIsAskedFor_ThenItsPlaceIsThatOfTheFile) {
  std::istringstream in("name,\"lo\nng\"\nab,cd\n");
  CsvRows rows(in, "t.csv", "L0041");
  ASSERT_TRUE(rows.next());
  ASSERT_TRUE(rows.next());
  EXPECT_EQ(rows.line(), 3U);
  EXPECT_EQ(rows.where(1).line, 3U);
  EXPECT_EQ(rows.where(1).column, 4U);
}

TEST(CsvRows, WhenALineHasOnlyCommas_ThenItIsNoRow) {
  const Read read_rows = read("a,b\n,\n,,,\n1,\n,2\n\"\",\"\"\n,,");
  ASSERT_EQ(read_rows.rows.size(), 3U) << read_rows.error;
  EXPECT_EQ(read_rows.rows[1], (std::vector<std::string>{"1", ""}));
  EXPECT_EQ(read_rows.rows[2], (std::vector<std::string>{"", "2"}));
}

TEST(CsvRows, WhenQuotesAreWrong_ThenTheFieldIsNamedAndReadingEnds) {
  const Read open = read("a,b\n1,\"2\n3,4\n");
  EXPECT_EQ(open.rows.size(), 1U);
  EXPECT_NE(open.error.find("t.csv:2:3: L0041: the quotes of this field do not end"), std::string::npos)
      << open.error;
  const Read behind = read("\"a\"b,c\n");
  EXPECT_TRUE(behind.rows.empty());
  EXPECT_NE(behind.error.find("t.csv:1:1: L0041: behind the quotes"), std::string::npos) << behind.error;
}

TEST(CsvRows, WhenARowDoesNotEnd_ThenNoMoreThanAMebibyteOfItIsRead) {
  const Read quoted = read("a,b\n\"" + std::string(3U << 20, 'x'));
  EXPECT_EQ(quoted.rows.size(), 1U);
  EXPECT_NE(quoted.error.find("longer than a mebibyte"), std::string::npos) << quoted.error;
  const Read commas = read(std::string(3U << 20, ','));
  EXPECT_TRUE(commas.rows.empty());
  EXPECT_NE(commas.error.find("longer than a mebibyte"), std::string::npos) << commas.error;
}

}  // namespace
}  // namespace stepwright::csv
