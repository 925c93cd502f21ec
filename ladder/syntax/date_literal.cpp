#include "ladder/syntax/date_literal.h"

#include <array>
#include <chrono>

#include "ladder/syntax/number.h"

namespace stepwright::syntax {

namespace {

constexpr std::int64_t kNsPerSecond = 1'000'000'000;

// Splits "a<mark>b<mark>c" into three numbers of decimal digits; nothing if it is not of that form.
std::optional<std::array<std::uint64_t, 3>> three_numbers(std::string_view text, char mark) {
  std::array<std::uint64_t, 3> numbers{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t end = text.find(mark);
    if ((end == std::string_view::npos) != (i == 2)) return std::nullopt;
    const auto number = parse_integer(text.substr(0, end), 10);
    if (!number) return std::nullopt;
    numbers[i] = *number;
    if (i < 2) text.remove_prefix(end + 1);
  }
  return numbers;
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// ".360_227_4" in nanoseconds; single underscores may divide the digits.
std::optional<std::int64_t> fraction_ns(std::string_view digits) {
  if (digits.empty() || !is_digit(digits.back())) return std::nullopt;
  std::int64_t ns = 0;
  std::int64_t scale = kNsPerSecond;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    const char c = digits[i];
    if (c == '_' && i > 0 && digits[i - 1] != '_') continue;
    if (!is_digit(c)) return std::nullopt;
    scale /= 10;
    ns += (c - '0') * scale;
  }
  return ns;
}

// Whole days since 1970-01-01 of dates whose day lies within 64 bits of nanoseconds.
std::optional<std::int64_t> days_of(std::string_view text) {
  const auto numbers = three_numbers(text, '-');
  if (!numbers || (*numbers)[0] > 9999 || (*numbers)[1] > 12 || (*numbers)[2] > 31) return std::nullopt;
  const std::chrono::year_month_day date{std::chrono::year(static_cast<int>((*numbers)[0])),
                                         std::chrono::month(static_cast<unsigned>((*numbers)[1])),
                                         std::chrono::day(static_cast<unsigned>((*numbers)[2]))};
  if (!date.ok()) return std::nullopt;
  const std::int64_t days = std::chrono::sys_days(date).time_since_epoch().count();
  constexpr std::int64_t kMostDays = 106'750;
  if (days > kMostDays || days < -kMostDays) return std::nullopt;
  return days;
}

}  // namespace

std::optional<std::int64_t> parse_date(std::string_view text) {
  const auto days = days_of(text);
  return days ? std::optional(*days * 86'400 * kNsPerSecond) : std::nullopt;
}

std::optional<std::int64_t> parse_time_of_day(std::string_view text) {
  std::int64_t fraction = 0;
  if (const std::size_t dot = text.find('.'); dot != std::string_view::npos) {
    const auto ns = fraction_ns(text.substr(dot + 1));
    if (!ns) return std::nullopt;
    fraction = *ns;
    text = text.substr(0, dot);
  }
  const auto numbers = three_numbers(text, ':');
  if (!numbers || (*numbers)[0] > 23 || (*numbers)[1] > 59 || (*numbers)[2] > 59) return std::nullopt;
  const std::uint64_t seconds = ((*numbers)[0] * 60 + (*numbers)[1]) * 60 + (*numbers)[2];
  return static_cast<std::int64_t>(seconds) * kNsPerSecond + fraction;
}

std::optional<std::int64_t> parse_date_and_time(std::string_view text) {
  const std::size_t middle = text.rfind('-');
  if (middle == std::string_view::npos) return std::nullopt;
  const auto date = parse_date(text.substr(0, middle));
  const auto time = parse_time_of_day(text.substr(middle + 1));
  return date && time ? std::optional(*date + *time) : std::nullopt;
}

}  // namespace stepwright::syntax
