#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "runtime/trace/csv_trace.h"
#include "runtime/trace/names.h"

namespace stepwright::trace {
namespace {

using bytecode::ElementaryType;

std::string temporary(const char* name) {
  return ::testing::TempDir() + "trace_test_" + std::to_string(::getpid()) + name;
}

std::string text_of(const std::string& path) {
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  std::filesystem::remove(path);
  return text.str();
}

TEST(CsvTrace, WhenValuesAreOfAllSorts_ThenTheTableIsRfc4180) {
  std::vector<std::byte> image(64);
  const auto put = [&](std::uint32_t at, auto value) {
    std::memcpy(image.data() + at, &value, sizeof value);
  };
  put(0, std::uint8_t{1});
  put(1, std::int16_t{-7});
  put(3, 0.1f);
  put(7, std::int64_t{-1'500'000'000});
  put(15, std::uint16_t{10});  // a string of ten characters at most: capacity, length, text
  put(17, std::uint16_t{6});
  std::memcpy(image.data() + 19, "a,\"b\"\n", 6);
  put(40, std::int32_t{2});
  const auto names = std::make_shared<const reader::Enumerators>(reader::Enumerators{{2, "Auto"}});
  CsvTrace csv(temporary(".csv"));
  ASSERT_TRUE(csv.columns({{"P.on", {ElementaryType::Bool, 0}},
                           {"P.n", {ElementaryType::Int, 1}},
                           {"P.x", {ElementaryType::Real, 3}},
                           {"P.delay", {ElementaryType::Time, 7}},
                           {"P.grid[1,2]", {ElementaryType::String, 15}},
                           {"P.mode", {ElementaryType::Dint, 40, bytecode::kNoBit, names}}}));
  csv.row(1, 0, image);
  put(0, std::uint8_t{0});
  csv.row(2, 10'000'000, image);
  ASSERT_TRUE(csv.finish());
  EXPECT_EQ(text_of(temporary(".csv")),
            "scan,time_s,P.on,P.n,P.x,P.delay [s],\"P.grid[1,2]\",P.mode\r\n"
            "1,0.000000000,1,-7,0.1,-1.500000000,\"a,\"\"b\"\"\n\",Auto\r\n"
            "2,0.010000000,0,-7,0.1,-1.500000000,\"a,\"\"b\"\"\n\",Auto\r\n");
}

TEST(CsvTrace, WhenItCannotBeWritten_ThenItIsSaid) {
  CsvTrace nowhere("/no/such/folder/x.csv");
  EXPECT_FALSE(nowhere.columns({}));
  CsvTrace full("/dev/full");
  ASSERT_TRUE(full.columns({}));
  full.row(1, 0, {});
  const auto finished = full.finish();
  ASSERT_FALSE(finished);
  EXPECT_EQ(finished.error()[0].where.file, "/dev/full");
}

TEST(CsvTrace, WhenTimesAreExtreme_ThenTheyAreExact) {
  EXPECT_EQ(seconds_text(std::numeric_limits<std::int64_t>::min()), "-9223372036.854775808");
  EXPECT_EQ(seconds_text(-1), "-0.000000001");
}

TEST(Names, WhenTheyAreListed_ThenCommasInBracketsBelongToThem) {
  EXPECT_EQ(split_names("a[1,2], b ,,c"), (std::vector<std::string>{"a[1,2]", "b", "c"}));
  EXPECT_TRUE(split_names("").empty());
}

TEST(Names, WhenTheyAreInAFile_ThenEachKnowsItsPlace) {
  const std::string file = temporary(".list");
  std::ofstream(file) << "# what to look at\nMAIN.level\n\n  MAIN.pump   // the first\r\n";
  const auto names = read_names(file);
  ASSERT_TRUE(names);
  ASSERT_EQ(names->size(), 2u);
  EXPECT_EQ((*names)[1].name, "MAIN.pump");
  EXPECT_EQ((*names)[1].where.line, 4u);
  EXPECT_EQ((*names)[1].where.column, 3u);
  std::filesystem::remove(file);
  EXPECT_FALSE(read_names(file));
}

}  // namespace
}  // namespace stepwright::trace
