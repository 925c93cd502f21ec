#pragma once

// The values of date and time of day literals (IEC 61131-3, 6.3.5, table 9). Private to the lexer.
//
// All count nanoseconds in 64 bits, dates since 1970-01-01: they reach from 1677-09-22 to 2262-04-11.

#include <cstdint>
#include <optional>
#include <string_view>

namespace stepwright::syntax {

// "2026-11-21"
std::optional<std::int64_t> parse_date(std::string_view text);
// "15:36:55.36", since midnight; digits behind the nanosecond are cut off.
std::optional<std::int64_t> parse_time_of_day(std::string_view text);
// "2026-11-21-15:36:55.36"
std::optional<std::int64_t> parse_date_and_time(std::string_view text);

}  // namespace stepwright::syntax
