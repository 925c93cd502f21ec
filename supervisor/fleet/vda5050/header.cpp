#include "supervisor/fleet/vda5050/header.h"

#include <fmt/format.h>

namespace stepwright::fleet::vda5050 {

namespace {

// The number of exactly `digits` digits at `at`; nothing if there is none.
std::optional<int> number_at(std::string_view text, std::size_t at, std::size_t digits) {
  if (at + digits > text.size()) return std::nullopt;
  int value = 0;
  for (std::size_t k = at; k < at + digits; ++k) {
    if (text[k] < '0' || text[k] > '9') return std::nullopt;
    value = 10 * value + (text[k] - '0');
  }
  return value;
}

// Of ".125Z" or "Z".
std::optional<int> fraction_ms(std::string_view rest) {
  if (rest == "Z") return 0;
  if (rest.size() < 3 || rest.size() > 11 || rest.front() != '.' || rest.back() != 'Z') return std::nullopt;
  const std::string_view digits = rest.substr(1, rest.size() - 2);
  if (!number_at(digits, 0, digits.size())) return std::nullopt;
  const std::string three = (std::string(digits) + "00").substr(0, 3);
  return number_at(three, 0, 3);
}

}  // namespace

std::string to_text(Timestamp time) {
  const auto day = std::chrono::floor<std::chrono::days>(time);
  const std::chrono::year_month_day date(day);
  const std::chrono::hh_mm_ss clock(time - day);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:03}Z", static_cast<int>(date.year()),
                     static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                     clock.hours().count(), clock.minutes().count(), clock.seconds().count(),
                     clock.subseconds().count());
}

std::optional<Timestamp> timestamp_of(std::string_view text) {
  if (text.size() < 20 || text[4] != '-' || text[7] != '-' || text[10] != 'T' || text[13] != ':' ||
      text[16] != ':') {
    return std::nullopt;
  }
  const auto year = number_at(text, 0, 4), month = number_at(text, 5, 2), day = number_at(text, 8, 2);
  const auto hour = number_at(text, 11, 2), minute = number_at(text, 14, 2), second = number_at(text, 17, 2);
  const auto ms = fraction_ms(text.substr(19));
  if (!year || !month || !day || !hour || !minute || !second || !ms) return std::nullopt;
  const std::chrono::year_month_day date(std::chrono::year(*year),
                                         std::chrono::month(static_cast<unsigned>(*month)),
                                         std::chrono::day(static_cast<unsigned>(*day)));
  if (!date.ok() || *hour > 23 || *minute > 59 || *second > 59) return std::nullopt;
  return std::chrono::sys_days(date) + std::chrono::hours(*hour) + std::chrono::minutes(*minute) +
         std::chrono::seconds(*second) + std::chrono::milliseconds(*ms);
}

Header make_header(const Address& address, Topic topic, HeaderIds& ids, Timestamp now) {
  return {.header_id = ids.next(topic),
          .timestamp = now,
          .version = std::string(kVersion),
          .manufacturer = address.manufacturer,
          .serial_number = address.serial_number};
}

}  // namespace stepwright::fleet::vda5050
