#include "runtime/base/time_text.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <string>

#include "runtime/base/calendar.h"

namespace stepwright::base {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kDay = 86'400 * kSecond;

std::string str(const ShortText& text) {
  return {text.view().begin(), text.view().end()};
}

using Parser = bool (*)(std::span<const char>, std::int64_t&);

void expect_value(Parser parser, const std::string& text, std::int64_t expected) {
  std::int64_t ns = 0;
  EXPECT_TRUE(parser(std::span(text), ns)) << text;
  EXPECT_EQ(ns, expected) << text;
}

void expect_refused(Parser parser, const std::string& text) {
  std::int64_t ns = 7;
  EXPECT_FALSE(parser(std::span(text), ns)) << text;
  EXPECT_EQ(ns, 7) << text;
}

TEST(Calendar, Days_WhenTurnedIntoDatesAndBack_ThenAreTheSame) {
  CivilDate before = date_of(-110'001);
  for (std::int64_t days = -110'000; days < 110'000; ++days) {
    const CivilDate date = date_of(days);
    ASSERT_EQ(days_of(date), days);
    const bool next_day = date.day == before.day + 1 && date.month == before.month;
    ASSERT_TRUE(next_day || date.day == 1) << days;
    before = date;
  }
}

TEST(TimeText, Durations_WhenWritten_ThenNameTheirUnits) {
  EXPECT_EQ(str(text_of_time(0)), "T#0s");
  EXPECT_EQ(str(text_of_time(1'500'000'000)), "T#1s500ms");
  EXPECT_EQ(str(text_of_time(-5'000)), "T#-5us");
  EXPECT_EQ(str(text_of_time(25 * 3600 * kSecond + 1)), "T#1d1h1ns");
  EXPECT_EQ(str(text_of_time(std::numeric_limits<std::int64_t>::min())),
            "T#-106751d23h47m16s854ms775us808ns");
}

TEST(TimeText, Durations_WhenRead_ThenGiveNanoseconds) {
  expect_value(parse_time, "T#1h_30m", 5400 * kSecond);
  expect_value(parse_time, "t#1.5s", 1'500'000'000);
  expect_value(parse_time, "LTIME#-2d", -2 * kDay);
  expect_value(parse_time, "TIME#5us3ns", 5003);
  expect_value(parse_time, "T#0.0000000019s", 1);
  expect_value(parse_time, "T#0.1d", kDay / 10);
  expect_value(parse_time, "T#90m", 5400 * kSecond);
  for (const char* text : {"", "T#", "5s", "T#5", "T#5s3h", "T#5s5s", "T#1.5h3m", "T#1.h", "T#s", "T#5x",
                           "T#5s ", "T#5s_", "T#106752d", "D#5s"}) {
    expect_refused(parse_time, text);
  }
}

TEST(TimeText, Durations_WhenWrittenAndRead_ThenAreTheSame) {
  std::mt19937_64 random(17);
  for (int i = 0; i < 20'000; ++i) {
    const auto ns = static_cast<std::int64_t>(random()) >> (random() % 60);
    expect_value(parse_time, str(text_of_time(ns)), ns);
    expect_value(parse_date_and_time, str(text_of_date_and_time(ns)), ns);
  }
  const auto lowest = std::numeric_limits<std::int64_t>::min();
  expect_value(parse_time, str(text_of_time(lowest)), lowest);
}

TEST(TimeText, Dates_WhenWritten_ThenAreThoseOfTheCalendar) {
  EXPECT_EQ(str(text_of_date(0)), "D#1970-01-01");
  EXPECT_EQ(str(text_of_date(-1)), "D#1969-12-31");
  EXPECT_EQ(str(text_of_date(11016 * kDay + 5)), "D#2000-02-29");
  EXPECT_EQ(str(text_of_time_of_day(45'000 * kSecond + 500'000'000)), "TOD#12:30:00.5");
  EXPECT_EQ(str(text_of_time_of_day(kDay - 1)), "TOD#23:59:59.999999999");
  EXPECT_EQ(str(text_of_date_and_time(11016 * kDay + 3661 * kSecond)), "DT#2000-02-29-01:01:01");
}

TEST(TimeText, Dates_WhenRead_ThenGiveNanoseconds) {
  expect_value(parse_date, "D#2000-02-29", 11016 * kDay);
  expect_value(parse_date, "date#1970-1-1", 0);
  expect_value(parse_time_of_day, "TOD#01:01:01.25", 3661 * kSecond + 250'000'000);
  expect_value(parse_time_of_day, "LTIME_OF_DAY#0:0:0", 0);
  expect_value(parse_date_and_time, "DATE_AND_TIME#2000-02-29-01:01:01", 11016 * kDay + 3661 * kSecond);
}

TEST(TimeText, TextsThatAreNoDates_WhenRead_ThenAreRefused) {
  for (const char* text :
       {"", "D#", "D#2001-02-29", "D#2000-13-01", "D#2000-00-01", "D#2000-01-00", "D#2000-01", "2000-01-01",
        "D#2000-01-01-", "D#9999-01-01", "D#0001-01-01", "D#10000-01-01"}) {
    expect_refused(parse_date, text);
  }
  for (const char* text :
       {"TOD#24:00:00", "TOD#1:60:00", "TOD#1:00:60", "TOD#1:00", "TOD#1:00:00.", "1:00:00"}) {
    expect_refused(parse_time_of_day, text);
  }
  for (const char* text : {"DT#2000-01-01", "DT#2000-01-01 01:01:01", "DT#2000-01-01-01:01:01x"}) {
    expect_refused(parse_date_and_time, text);
  }
}

}  // namespace
}  // namespace stepwright::base
