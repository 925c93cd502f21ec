#pragma once

// The values of numeric and duration literals (IEC 61131-3, 6.3). Private to the lexer.

#include <cstdint>
#include <optional>
#include <string_view>

namespace stepwright::syntax {

// "1_000", base 2..16; nothing on a wrong digit, a misplaced underscore or more than 64 bits.
std::optional<std::uint64_t> parse_integer(std::string_view digits, unsigned base);
// "1_000.5E-3"
std::optional<double> parse_real(std::string_view text);
// "1d2h3m4s5ms6us7ns", "-1.5s", in nanoseconds. Units descend, only the last part may have a fraction.
std::optional<std::int64_t> parse_duration(std::string_view text);

}  // namespace stepwright::syntax
