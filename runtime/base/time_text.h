#pragma once

// Durations and dates as literals of IEC 61131-3 (tables 8 and 9) and back. All are int64 nanoseconds: of a
// duration, since 1970-01-01, or since midnight. Portable: no heap, no time zone, no leap seconds.

#include <cstdint>
#include <span>

#include "runtime/base/short_text.h"

namespace stepwright::base {

// "T#1h2m3s4ms", "T#-5us", "T#0s": units that are zero are left out.
ShortText text_of_time(std::int64_t ns);

// "D#2024-02-29": of the day in which the instant lies.
ShortText text_of_date(std::int64_t ns);

// "TOD#12:30:00.5": of the instant within its day; the fraction without zeros at its end.
ShortText text_of_time_of_day(std::int64_t ns);

// "DT#2024-02-29-12:30:00"
ShortText text_of_date_and_time(std::int64_t ns);

// Whole texts with one of the prefixes of their type, long or short, in any case: T#, TIME#, LT#, LTIME#; D#,
// DATE#, LD#, LDATE#; TOD#, TIME_OF_DAY#, LTOD#, LTIME_OF_DAY#; DT#, DATE_AND_TIME#, LDT#,
// LDATE_AND_TIME#. Digits finer than a nanosecond are dropped. False, and `ns` unchanged, if the text is no
// such literal or out of range.
bool parse_time(std::span<const char> text, std::int64_t& ns);
bool parse_date(std::span<const char> text, std::int64_t& ns);
bool parse_time_of_day(std::span<const char> text, std::int64_t& ns);
bool parse_date_and_time(std::span<const char> text, std::int64_t& ns);

}  // namespace stepwright::base
