#pragma once

// Durations of timed formulas, in the standard's spelling. Private to this library. Thread rule: pure.

#include <cstdint>
#include <optional>
#include <string_view>

namespace stepwright::ltl {

// "T#1m30s", "T#0.5s", "T#250ms": nanoseconds, whole milliseconds. Nothing for what is no such text, below 1
// ms or above 1,000 hours.
std::optional<std::int64_t> duration_ns(std::string_view text);

}  // namespace stepwright::ltl
