#pragma once

// Texts of floating-point numbers, as std::to_chars and std::from_chars have them, for the formats and texts
// that runtime/base/number_text.cpp uses: `fixed` below 10^15, `scientific`, and plain decimal literals. Pure
// functions without a heap.

#include <charconv>

namespace stepwright::decimal {

// Requires a finite number, for `fixed` one below 10^15, and 40 characters of room.
std::to_chars_result to_characters(char* first, char* last, float value, std::chars_format format);
std::to_chars_result to_characters(char* first, char* last, double value, std::chars_format format);

// [-] digits [. digits] [e [-] digits], to the end.
std::from_chars_result from_characters(const char* first, const char* last, float& value);
std::from_chars_result from_characters(const char* first, const char* last, double& value);

}  // namespace stepwright::decimal
