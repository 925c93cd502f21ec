#pragma once

// Durations of task intervals. Internal to this folder.

#include <cstdint>
#include <optional>
#include <string>

namespace stepwright::exchange {

// "T#1s500ms", "TIME#20ms", "10ms", "t#0.5s" in microseconds; nullopt if it is no duration or no whole number
// of microseconds.
std::optional<std::int64_t> duration_us(const std::string& text);

// "00:00:00.100000", hours, minutes and seconds of files before version 2, in microseconds; nullopt if it is
// none or no whole number of them.
std::optional<std::int64_t> clock_duration_us(const std::string& text);

// A duration of XML Schema, as "PT0.05S" and "PT1M30S" of days, hours, minutes and seconds, in microseconds;
// nullopt if it is none or no whole number of them.
std::optional<std::int64_t> xsd_duration_us(const std::string& text);

}  // namespace stepwright::exchange
