#pragma once

// Durations of task intervals. Internal to this folder.

#include <cstdint>
#include <optional>
#include <string>

namespace stepwright::exchange {

// "T#1s500ms", "TIME#20ms", "10ms", "t#0.5s" in microseconds; nullopt if it is no duration or no whole number
// of microseconds.
std::optional<std::int64_t> duration_us(const std::string& text);

}  // namespace stepwright::exchange
