#pragma once

// Days and dates of the Gregorian calendar, also before its introduction (as ISO 8601 does it).

#include <cstdint>

namespace stepwright::base {

struct CivilDate {
  std::int32_t year = 1970;
  std::uint32_t month = 1;  // 1..12
  std::uint32_t day = 1;    // 1..31
  friend constexpr bool operator==(const CivilDate&, const CivilDate&) = default;
};

constexpr bool is_leap_year(std::int32_t year) {
  return year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
}

// Requires a month of 1..12.
constexpr std::uint32_t days_in_month(std::int32_t year, std::uint32_t month) {
  constexpr std::uint8_t kDays[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  return month == 2 && is_leap_year(year) ? 29 : kDays[month - 1];
}

// Days before the first of January of a year of 0 or later, counted from 0000-01-01.
constexpr std::int64_t days_before_year(std::int64_t year) {
  const std::int64_t before = year - 1;
  return year == 0 ? 0 : 366 + before * 365 + before / 4 - before / 100 + before / 400;
}

// Days since 1970-01-01. Requires a valid date of the years 0 to 9999.
constexpr std::int64_t days_of(const CivilDate& date) {
  std::int64_t days = days_before_year(date.year) - days_before_year(1970);
  for (std::uint32_t month = 1; month < date.month; ++month) days += days_in_month(date.year, month);
  return days + date.day - 1;
}

// The date that many days after 1970-01-01. Requires a result of the years 0 to 9999.
constexpr CivilDate date_of(std::int64_t days) {
  const std::int64_t since_zero = days + days_before_year(1970);
  CivilDate date;
  // 400 years are 146097 days, so that the guess is right or one year too late.
  date.year = static_cast<std::int32_t>(since_zero * 400 / 146097);
  while (days_before_year(date.year) > since_zero) --date.year;
  while (days_before_year(date.year + 1) <= since_zero) ++date.year;
  auto rest = static_cast<std::uint32_t>(since_zero - days_before_year(date.year));
  while (rest >= days_in_month(date.year, date.month)) rest -= days_in_month(date.year, date.month++);
  date.day = rest + 1;
  return date;
}

static_assert(days_of({1970, 1, 1}) == 0 && days_of({2000, 2, 29}) == 11016);
static_assert(date_of(11016) == CivilDate{2000, 2, 29} && date_of(-1) == CivilDate{1969, 12, 31});

}  // namespace stepwright::base
