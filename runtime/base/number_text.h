#pragma once

// Numbers as literals of IEC 61131-3 (table 5) and back, exactly: a REAL is written with as few digits as
// give the same number when read. Portable: no heap, no locale. Any text is safe to parse.
//
//   base::ShortText text = base::text_of(0.1f);               // "0.1"
//   float value = 0; bool good = base::parse(text.view(), value);

#include <cstdint>
#include <span>

#include "runtime/base/short_text.h"

namespace stepwright::base {

// "-12"
ShortText text_of(std::int64_t value);
ShortText text_of(std::uint64_t value);

// "0.1", "100000.0", "1.5E-07"; "Infinity", "-Infinity" and "NaN", which are no literals.
ShortText text_of(float value);
ShortText text_of(double value);

// A whole text that is an integer literal: [sign] digits, or 2#, 8# or 16# and digits; underscores between
// digits. False, and `value` unchanged, if it is none or out of range.
bool parse(std::span<const char> text, std::int64_t& value);
bool parse(std::span<const char> text, std::uint64_t& value);

// A whole text that is an integer or a real literal: [sign] digits [. digits] [E [sign] digits], at most 255
// characters. The nearest number, ties to even. False, and `value` unchanged, if it is none or out of range.
bool parse(std::span<const char> text, float& value);
bool parse(std::span<const char> text, double& value);

// TRUE, FALSE, 1 or 0, upper and lower case alike.
bool parse(std::span<const char> text, bool& value);

}  // namespace stepwright::base
