#include "runtime/base/time_text.h"

#include <limits>

#include "runtime/base/calendar.h"
#include "runtime/base/text_cursor.h"

namespace stepwright::base {

namespace {

constexpr std::int64_t kSecondNs = 1'000'000'000;
constexpr std::int64_t kDayNs = 86'400 * kSecondNs;

struct Unit {
  const char* name;
  const char* literal;  // as TextCursor reads it
  std::uint64_t ns;
};
constexpr Unit kUnits[] = {{"d", "D", 86'400'000'000'000},
                           {"h", "H", 3'600'000'000'000},
                           {"m", "M", 60'000'000'000},
                           {"s", "S", 1'000'000'000},
                           {"ms", "MS", 1'000'000},
                           {"us", "US", 1'000},
                           {"ns", "NS", 1}};
constexpr std::size_t kUnitCount = std::size(kUnits);

// Days and the rest of the day, rounded towards the past.
std::int64_t day_of(std::int64_t ns) {
  return ns / kDayNs - (ns % kDayNs < 0 ? 1 : 0);
}
std::int64_t within_day(std::int64_t ns) {
  const std::int64_t rest = ns % kDayNs;
  return rest < 0 ? rest + kDayNs : rest;
}

void push_date(ShortText& text, std::int64_t ns) {
  const CivilDate date = date_of(day_of(ns));
  text.push_number(static_cast<std::uint64_t>(date.year), 4);
  text.push('-');
  text.push_number(date.month, 2);
  text.push('-');
  text.push_number(date.day, 2);
}

void push_clock(ShortText& text, std::int64_t ns) {
  const auto rest = static_cast<std::uint64_t>(within_day(ns));
  const std::uint64_t seconds = rest / kSecondNs;
  text.push_number(seconds / 3600, 2);
  text.push(':');
  text.push_number(seconds / 60 % 60, 2);
  text.push(':');
  text.push_number(seconds % 60, 2);
  std::uint64_t fraction = rest % kSecondNs;
  if (fraction == 0) return;
  std::uint32_t digits = 9;
  for (; fraction % 10 == 0; fraction /= 10) --digits;
  text.push('.');
  text.push_number(fraction, digits);
}

// Digits behind a point, as a part of `unit`. From the last digit to the first each division drops what is
// finer than a nanosecond, and no more than that.
std::uint64_t fraction_of(std::span<const char> digits, std::uint64_t unit) {
  std::uint64_t part = 0;
  for (std::size_t i = digits.size(); i > 0; --i) {
    if (digits[i - 1] == '_') continue;
    part = (static_cast<std::uint64_t>(digits[i - 1] - '0') * unit + part) / 10;
  }
  return part;
}

std::span<const char> take_digits(TextCursor& cursor, std::span<const char> text) {
  const std::size_t start = cursor.position();
  std::uint32_t digit = 0;
  if (!cursor.take_digit(10, digit)) return {};
  while (cursor.take_next_digit(10, digit)) {
  }
  return text.subspan(start, cursor.position() - start);
}

// The unit behind a number: the longest name that fits, at `first` or finer.
std::size_t take_unit(TextCursor& cursor, std::size_t first) {
  for (std::size_t i = kUnitCount; i > first; --i) {
    if (cursor.take_word(kUnits[i - 1].literal)) return i - 1;
  }
  return kUnitCount;
}

bool take_field(TextCursor& cursor, std::uint64_t below, std::uint64_t& value) {
  return cursor.at_digit() && cursor.take_number(value) && value < below;
}

bool take_date(TextCursor& cursor, std::int64_t& days) {
  std::uint64_t year = 0, month = 0, day = 0;
  if (!take_field(cursor, 10'000, year) || !cursor.take('-')) return false;
  if (!take_field(cursor, 13, month) || month == 0 || !cursor.take('-')) return false;
  const auto y = static_cast<std::int32_t>(year);
  const auto m = static_cast<std::uint32_t>(month);
  if (!take_field(cursor, days_in_month(y, m) + 1, day) || day == 0) return false;
  days = days_of({y, m, static_cast<std::uint32_t>(day)});
  return true;
}

bool take_clock(TextCursor& cursor, std::span<const char> text, std::int64_t& ns) {
  std::uint64_t hour = 0, minute = 0, second = 0;
  if (!take_field(cursor, 24, hour) || !cursor.take(':')) return false;
  if (!take_field(cursor, 60, minute) || !cursor.take(':')) return false;
  if (!take_field(cursor, 60, second)) return false;
  ns = static_cast<std::int64_t>(hour * 3600 + minute * 60 + second) * kSecondNs;
  if (!cursor.take('.')) return true;
  const auto digits = take_digits(cursor, text);
  ns += static_cast<std::int64_t>(fraction_of(digits, kSecondNs));
  return !digits.empty();
}

bool from_days(std::int64_t days, std::int64_t rest, std::int64_t& ns) {
  std::int64_t result = 0;
  if (__builtin_mul_overflow(days, kDayNs, &result) || __builtin_add_overflow(result, rest, &result)) {
    return false;
  }
  ns = result;
  return true;
}

// The parts of a duration, the coarsest first, each unit once; only the last may have a fraction.
bool take_duration(TextCursor& cursor, std::span<const char> text, std::uint64_t& ns) {
  std::uint64_t sum = 0;
  bool fraction = false;
  for (std::size_t next = 0; next < kUnitCount && !fraction;) {
    std::uint64_t count = 0;
    if (!cursor.at_digit() || !cursor.take_number(count)) return false;
    std::span<const char> digits;
    if (cursor.take('.')) {
      digits = take_digits(cursor, text);
      fraction = true;
      if (digits.empty()) return false;
    }
    const std::size_t unit = take_unit(cursor, next);
    if (unit == kUnitCount) return false;
    std::uint64_t part = 0;
    if (__builtin_mul_overflow(count, kUnits[unit].ns, &part) || __builtin_add_overflow(sum, part, &sum) ||
        __builtin_add_overflow(sum, fraction_of(digits, kUnits[unit].ns), &sum)) {
      return false;
    }
    ns = sum;
    if (cursor.at_end()) return true;
    static_cast<void>(cursor.take('_'));
    next = unit + 1;
  }
  return false;
}

}  // namespace

ShortText text_of_time(std::int64_t ns) {
  ShortText text;
  text.push("T#");
  if (ns < 0) text.push('-');
  std::uint64_t rest = ns < 0 ? 0 - static_cast<std::uint64_t>(ns) : static_cast<std::uint64_t>(ns);
  if (rest == 0) text.push("0s");
  for (const Unit& unit : kUnits) {
    if (rest >= unit.ns) {
      text.push_number(rest / unit.ns);
      text.push(unit.name);
    }
    rest %= unit.ns;
  }
  return text;
}

ShortText text_of_date(std::int64_t ns) {
  ShortText text;
  text.push("D#");
  push_date(text, ns);
  return text;
}

ShortText text_of_time_of_day(std::int64_t ns) {
  ShortText text;
  text.push("TOD#");
  push_clock(text, ns);
  return text;
}

ShortText text_of_date_and_time(std::int64_t ns) {
  ShortText text;
  text.push("DT#");
  push_date(text, ns);
  text.push('-');
  push_clock(text, ns);
  return text;
}

bool parse_time(std::span<const char> text, std::int64_t& ns) {
  constexpr const char* kPrefixes[] = {"T#", "TIME#", "LT#", "LTIME#"};
  constexpr auto kLargest = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  TextCursor cursor(text);
  if (!cursor.take_any(kPrefixes)) return false;
  const bool negative = cursor.take('-');
  if (!negative) static_cast<void>(cursor.take('+'));
  std::uint64_t magnitude = 0;
  if (!take_duration(cursor, text, magnitude) || magnitude > kLargest + (negative ? 1 : 0)) return false;
  ns = static_cast<std::int64_t>(negative ? 0 - magnitude : magnitude);
  return true;
}

bool parse_date(std::span<const char> text, std::int64_t& ns) {
  constexpr const char* kPrefixes[] = {"D#", "DATE#", "LD#", "LDATE#"};
  TextCursor cursor(text);
  std::int64_t days = 0;
  return cursor.take_any(kPrefixes) && take_date(cursor, days) && cursor.at_end() && from_days(days, 0, ns);
}

bool parse_time_of_day(std::span<const char> text, std::int64_t& ns) {
  constexpr const char* kPrefixes[] = {"TOD#", "TIME_OF_DAY#", "LTOD#", "LTIME_OF_DAY#"};
  TextCursor cursor(text);
  std::int64_t clock = 0;
  if (!cursor.take_any(kPrefixes) || !take_clock(cursor, text, clock) || !cursor.at_end()) return false;
  ns = clock;
  return true;
}

bool parse_date_and_time(std::span<const char> text, std::int64_t& ns) {
  constexpr const char* kPrefixes[] = {"DT#", "DATE_AND_TIME#", "LDT#", "LDATE_AND_TIME#"};
  TextCursor cursor(text);
  std::int64_t days = 0;
  std::int64_t clock = 0;
  return cursor.take_any(kPrefixes) && take_date(cursor, days) && cursor.take('-') &&
         take_clock(cursor, text, clock) && cursor.at_end() && from_days(days, clock, ns);
}

}  // namespace stepwright::base
